//! Addresses of links as users write them, and the refusals that name a better one.

use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs as _, UdpSocket};

use anyhow::{Context as _, anyhow, bail, ensure};

use super::{LISTEN_PORT, PEER_PORT, TCP_PORT};

/// An address as a user writes it: `127.0.0.1:14550`, `localhost`, `[::1]:14550`; `:14580` for every interface.
///
/// # Errors
/// One line with the invalid text and a valid example, or the unknown host.
pub fn parse(text: &str, default_port: u16) -> anyhow::Result<SocketAddr> {
    if let Ok(address) = text.parse() {
        return Ok(address);
    }
    ensure!(!text.trim().is_empty(), "the address is missing: use 127.0.0.1:{default_port}");
    // The system would take a whole number for an address.
    if text.parse::<u32>().is_ok() {
        let port = text.parse::<u16>().ok();
        let port =
            port.with_context(|| format!("`{text}` is no port from 0 to 65535: use 127.0.0.1:{default_port}"))?;
        bail!("`{text}` is no address: for a port use 127.0.0.1:{port}");
    }
    let in_brackets = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
    if let Ok(ip) = in_brackets.unwrap_or(text).parse::<IpAddr>() {
        return Ok(SocketAddr::new(ip, default_port));
    }
    let (host, port) = text.rsplit_once(':').map_or((text, None), |(host, port)| (host, Some(port)));
    ensure!(!host.contains(['/', ':', '[', ']', ' ']), "`{text}` is no address: use 127.0.0.1:{default_port}");
    let port = match port {
        Some(port) => {
            let port = port.parse::<u16>().ok();
            port.with_context(|| format!("`{text}` has no port from 0 to 65535: use {host}:{default_port}"))?
        }
        None => default_port,
    };
    if host.is_empty() {
        return Ok(SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), port));
    }
    let known = (host, port).to_socket_addrs().map(Iterator::collect::<Vec<_>>).unwrap_or_default();
    // `localhost` is both; ground stations listen by IPv4.
    let chosen = known.iter().find(|address| address.is_ipv4()).or(known.first());
    chosen.copied().with_context(|| format!("the host `{host}` is not known: use an address, as 127.0.0.1:{port}"))
}

/// The same address with the port beside its own.
pub(super) fn beside(address: SocketAddr) -> SocketAddr {
    let port = address.port();
    SocketAddr::new(address.ip(), if port == u16::MAX { port - 1 } else { port + 1 })
}

pub(super) fn cannot_listen(listen: SocketAddr, peers: &[SocketAddr], error: &std::io::Error) -> anyhow::Error {
    match error.kind() {
        ErrorKind::AddrInUse => {
            let peer = peers.first().copied().unwrap_or_else(|| elsewhere(listen));
            anyhow!(
                "{listen} is in use (another `sim-host serve`?): stop it, or fly another vehicle for another ground \
                 station with --listen {} --peer {}",
                beside(listen),
                beside(peer)
            )
        }
        _ => cannot_have("--listen", listen, LISTEN_PORT, error)
            .unwrap_or_else(|| anyhow!("cannot listen on UDP address {listen}: {error}")),
    }
}

pub(super) fn cannot_listen_by_tcp(listen: SocketAddr, error: &std::io::Error) -> anyhow::Error {
    if error.kind() == ErrorKind::AddrInUse {
        return anyhow!(
            "--tcp {listen} is in use (another `sim-host serve`?): stop it, or use --tcp {}",
            beside(listen)
        );
    }
    cannot_have("--tcp", listen, TCP_PORT, error)
        .unwrap_or_else(|| anyhow!("cannot listen on TCP address {listen}: {error}"))
}

/// Why no program can listen on an address, given by `option`.
fn cannot_have(option: &str, listen: SocketAddr, usual: u16, error: &std::io::Error) -> Option<anyhow::Error> {
    let (ip, port) = (listen.ip(), listen.port());
    match error.kind() {
        ErrorKind::AddrNotAvailable => Some(anyhow!(
            "{ip} is no address of this machine: use {option} 127.0.0.1:{port}, or :{port} for all of its own"
        )),
        ErrorKind::PermissionDenied => {
            Some(anyhow!("port {port} is for privileged programs: choose one from 1024 up, as {option} {ip}:{usual}"))
        }
        _ => None,
    }
}

/// Whether what is sent to `peer` comes in at `own` again.
pub fn is_own(own: SocketAddr, peer: &SocketAddr) -> bool {
    // Only an address of this machine can be bound.
    let is_this_machine = || UdpSocket::bind((peer.ip(), 0)).is_ok();
    own.port() == peer.port() && (own.ip() == peer.ip() || (own.ip().is_unspecified() && is_this_machine()))
}

/// Where ground stations listen on this machine, unless that is `own`.
pub fn elsewhere(own: SocketAddr) -> SocketAddr {
    let ip = if own.ip().is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { own.ip() };
    SocketAddr::new(ip, if own.port() == PEER_PORT { LISTEN_PORT } else { PEER_PORT })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_address_is_answered_with_one() {
        for text in ["", " ", ":::", "a b", "[::1", "[]:1", "http://x", "udp:127.0.0.1:14550", "127.0.0.1:", ":x"] {
            let error = format!("{:#}", parse(text, PEER_PORT).expect_err(text));
            assert!(error.contains(":14550") && !error.contains('\n'), "{text}: {error}");
        }
    }

    #[test]
    fn an_address_may_be_a_name_a_port_or_neither() {
        let at = |text: &str| parse(text, PEER_PORT).map(|address| address.to_string());
        for (text, expected) in [
            ("127.0.0.1:14551", "127.0.0.1:14551"),
            ("127.0.0.1", "127.0.0.1:14550"),
            ("localhost", "127.0.0.1:14550"),
            ("localhost:1", "127.0.0.1:1"),
            (":14580", "0.0.0.0:14580"),
            ("[::1]:5", "[::1]:5"),
            ("::1", "[::1]:14550"),
        ] {
            assert_eq!(at(text).expect(text), expected);
        }
        for (text, expected) in [
            ("14551", "`14551` is no address: for a port use 127.0.0.1:14551"),
            ("99999", "`99999` is no port from 0 to 65535: use 127.0.0.1:14550"),
        ] {
            assert_eq!(format!("{:#}", at(text).expect_err(text)), expected);
        }
        for (text, expected) in [("localhost:many", "localhost:14550"), ("localhost:70000", "65535")] {
            let error = format!("{:#}", at(text).expect_err(text));
            assert!(error.contains(expected), "{error}");
        }
    }
}
