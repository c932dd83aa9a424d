"""The links of README, changelog and manual, in the sources and in the book that mdBook makes of docs/.

A link into the project must lead to a file, and its `#anchor` to a heading of that file. Addresses outside are only
looked at for their form: a test must not depend on other people's servers.
"""

import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted(DOCS.glob("*.md"))]
MDBOOK = shutil.which("mdbook", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))

FENCED = re.compile(r"^(```+|~~~+).*?^\1\s*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)")
REFERENCE = re.compile(r"^\[[^\]]+\]:\s*<?(\S+?)>?\s*$", re.MULTILINE)
HEADING = re.compile(r"^#{1,6}\s+(.+?)\s*#*$", re.MULTILINE)


def prose(text):
    """A page without its code, in which brackets are no links."""
    return FENCED.sub("", text)


def slug(heading):
    """A heading's anchor, as GitHub and mdBook make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-")


def anchors(text):
    seen = {}
    for heading in HEADING.findall(prose(text)):
        name = slug(heading)
        seen[name] = seen.get(name, -1) + 1
        yield f"{name}-{seen[name]}" if seen[name] else name


def links(text):
    text = re.sub(r"`[^`\n]*`", "", prose(text))
    return LINK.findall(text) + REFERENCE.findall(text)


def fault(page, link, anchors_of):
    """Why a link of a page leads nowhere, or None."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        well_formed = parts.netloc if parts.scheme in ("https", "http") else parts.scheme == "mailto" and parts.path
        return None if well_formed else "malformed"
    target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    if not target.exists():
        return f"no file {parts.path}"
    if parts.fragment and unquote(parts.fragment) not in anchors_of(target):
        return f"no heading #{parts.fragment}"
    return None


def faults(pages, links_of, anchors_of):
    found = ((page, link, fault(page, link, anchors_of)) for page in pages for link in links_of(page))
    return [f"{page.name}: {link}: {why}" for page, link, why in found if why]


def markdown_faults(pages):
    return faults(pages, lambda page: links(page.read_text()), lambda page: set(anchors(page.read_text())))


class Html(HTMLParser):
    """What a page of the book links to, and the anchors that it has."""

    def __init__(self, page):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors.update(attributes[key] for key in ("id", "name") if attributes.get(key))
        self.links += [attributes[key] for key in ("href", "src") if attributes.get(key)]


def test_every_link_leads_somewhere():
    assert sum(len(links(page.read_text())) for page in PAGES) > 40
    assert markdown_faults(PAGES) == []


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# One way\n[a](#one-way) [b](#two) [c](gone.md) [d](https:///x) `[e](code.md)`\n```\n[f](f.md)\n```\n")
    assert markdown_faults([page]) == [
        "page.md: #two: no heading #two",
        "page.md: gone.md: no file gone.md",
        "page.md: https:///x: malformed",
    ]


def test_what_the_table_of_equations_names_is_there():
    section = (DOCS / "paper.md").read_text().split("## Where each equation is\n")[1].split("\n## ")[0]
    named, file = 0, None
    for name in re.findall(r"`([^`]+)`", section):
        if name == "paper-decoupled":
            continue
        if "/" in name:
            file = (ROOT / name).read_text()
        else:
            assert re.search(rf"\b(fn|struct|enum) {name}\b", file), f"docs/paper.md: {name}"
            named += 1
    assert named > 10


def test_the_book_holds_every_page_and_its_links_lead_somewhere():
    assert MDBOOK, "mdbook is not installed: pip install -r tests/requirements.txt"
    listed = set(links((DOCS / "SUMMARY.md").read_text()))
    assert listed == {page.name for page in DOCS.glob("*.md")} - {"SUMMARY.md"}
    built = subprocess.run([MDBOOK, "build", str(DOCS)], capture_output=True, text=True)
    assert built.returncode == 0 and not re.search(r"WARN|ERROR", built.stderr), built.stderr
    book = ROOT / "target" / "book"
    pages = {page: Html(page) for page in book.glob("*.html") if page.name not in ("404.html", "print.html", "toc.html")}
    assert len(pages) > len(listed)
    broken = faults(pages, lambda page: pages[page].links, lambda page: Html(page).anchors)
    assert broken == []
