//! Names that were nearly right.

/// "did you mean `x`?", or what there is.
pub(crate) fn did_you_mean(name: &str, known: &[&str]) -> String {
    /// Of 1.
    const LIKE: f64 = 0.8;
    let likeness = |candidate: &str| strsim::jaro_winkler(name, candidate);
    let nearest = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    match nearest.filter(|nearest| likeness(nearest) > LIKE) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("use one of {}", known.join(", ")),
    }
}
