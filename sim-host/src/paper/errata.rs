//! What of the paper cannot be taken as printed, and what it would do to these flights. All of it, with the derivations,
//! is in docs/control-laws.md.

use serde::Serialize;

/// A misprint or an omission.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Erratum {
    /// Equation, table or figure.
    pub place: &'static str,
    /// What it says.
    pub printed: &'static str,
    /// What is flown.
    pub flown: &'static str,
    /// What the printed form would do.
    pub effect: &'static str,
}

/// Those that change a flight, in the paper's order.
pub const ERRATA: [Erratum; 7] = [
    Erratum {
        place: "Eq. 2",
        printed: "drag torque −k φ̇²",
        flown: "−k φ̇|φ̇|",
        effect: "a square pushes one way always: it accelerates a body that turns backwards",
    },
    Erratum {
        place: "Eq. 8, ẋ8",
        printed: "cφ sθ sψ + sφ sψ",
        flown: "cφ sθ cψ + sφ sψ",
        effect: "at heading 0, that of the helix, both terms vanish: nothing would move x",
    },
    Erratum {
        place: "Eq. 11, θd",
        printed: "Ux cψ − Uy sψ",
        flown: "Ux cψ + Uy sψ",
        effect: "the thrust points elsewhere, but for a heading of 0",
    },
    Erratum {
        place: "Eq. 25, first line",
        printed: "+ c2 x2² + c3 Ωr x4",
        flown: "both with minus, as in its second line",
        effect: "doubles the drag it should cancel: beyond 3.2 rad/s that is more than K = 224.5 rad/s²",
    },
    Erratum {
        place: "Eq. 2, 25, 26",
        printed: "Ωr is not defined",
        flown: "−ω1 + ω2 − ω3 + ω4 with rotors; 0 in the decoupled model",
        effect: "one of two signs, of which the other does not conserve angular momentum",
    },
    Erratum {
        place: "Table 2",
        printed: "“translational (K4,5,6)”",
        flown: "k1..3 translate, k4..6 turn",
        effect: "the labels contradict Eq. 2",
    },
    Erratum {
        place: "Section 4.1",
        printed: "tracking error “nearly 0.002 s”",
        flown: "0.002 m",
        effect: "an error of altitude is a length",
    },
];

#[cfg(test)]
mod tests {
    #[test]
    fn doubled_drag_outgrows_the_gain_where_the_table_says() {
        // 2 k4/Ix φ̇² = K with Table 2's k4 and Ix.
        let rate = (224.5_f64 / (2.0 * 0.0556 / 0.5e-2)).sqrt();
        assert!((rate - 3.2).abs() < 0.05, "{rate}");
    }
}
