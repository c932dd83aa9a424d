//! Instruction statistics of a section.

/// Statistics of one section.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    pub(crate) calls: u32,
    pub(crate) max: u32,
    sum: u64,
}

impl Tally {
    pub(crate) fn add(&mut self, instructions: u32) {
        self.calls += 1;
        self.max = self.max.max(instructions);
        self.sum += u64::from(instructions);
    }

    pub(crate) fn mean(&self) -> f32 {
        self.sum as f32 / self.calls as f32
    }
}
