//! What the paper states as a number, and where: the one place that tables, sweeps and documents take it from.

/// A time that the paper claims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperClaim {
    /// What happens from then on, or within it.
    pub what: &'static str,
    /// The time claimed, s.
    pub time_s: f64,
    /// Section and figure.
    pub source: &'static str,
}

/// x follows 4 sin t from the start.
pub const X_FOLLOWS: PaperClaim =
    PaperClaim { what: "x follows 4 sin t from 0 s on", time_s: 0.0, source: "Section 4.1, Figure 3" };

/// y follows 5 cos t.
pub const Y_FOLLOWS: PaperClaim =
    PaperClaim { what: "y follows 5 cos t after 0.4 s", time_s: 0.4, source: "Section 4.1, Figure 3" };

/// z follows 2 + t.
pub const Z_FOLLOWS: PaperClaim =
    PaperClaim { what: "z follows 2 + t after 0.35 s", time_s: 0.35, source: "Section 4.1, Figure 2 a" };

/// The error of z is down to [`ALTITUDE_ERROR_M`].
pub const ALTITUDE_ERROR: PaperClaim = PaperClaim {
    what: "the error of z is “nearly 0.002” from 0.45 s on",
    time_s: 0.45,
    source: "Section 4.1, Figure 2 b",
};

/// The error that [`ALTITUDE_ERROR`] is about, m. The paper prints it in seconds.
pub const ALTITUDE_ERROR_M: f64 = 0.002;

/// The error rate of z has gone to zero.
pub const ALTITUDE_AT_REST: PaperClaim = PaperClaim {
    what: "the error rate of z goes to zero within 0.3 s",
    time_s: 0.3,
    source: "Section 4.1, Figure 2 c",
};

/// A Gaussian disturbance is removed in less than this.
pub const DISTURBANCE_REMOVED: PaperClaim =
    PaperClaim { what: "disturbance removed in under 0.2 s", time_s: 0.2, source: "Section 4.2, Figure 6" };

/// The whole system follows, on average, within this.
pub const AVERAGE_FOLLOWS: PaperClaim =
    PaperClaim { what: "all follow within 0.5 s on average", time_s: 0.5, source: "Section 5.1" };
