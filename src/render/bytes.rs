//! Numbers and lists of bytes, one after another, in little-endian order.

/// Why bytes do not say what they should.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CutOff;

/// Appends to bytes.
#[derive(Debug, Default)]
pub(super) struct Writer {
    pub(super) bytes: Vec<u8>,
}

impl Writer {
    pub(super) fn number(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(super) fn real(&mut self, value: f64) {
        self.number(value.to_bits());
    }

    pub(super) fn list(&mut self, bytes: &[u8]) {
        self.number(bytes.len() as u64);
        self.bytes.extend_from_slice(bytes);
    }
}

/// Reads from bytes, and never beyond them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reader<'a> {
    pub(super) bytes: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(super) fn number(&mut self) -> Result<u64, CutOff> {
        let (number, rest) = self.bytes.split_first_chunk().ok_or(CutOff)?;
        self.bytes = rest;
        Ok(u64::from_le_bytes(*number))
    }

    pub(super) fn real(&mut self) -> Result<f64, CutOff> {
        self.number().map(f64::from_bits)
    }

    pub(super) fn list(&mut self) -> Result<&'a [u8], CutOff> {
        let length = usize::try_from(self.number()?).map_err(|_| CutOff)?;
        let (list, rest) = self.bytes.split_at_checked(length).ok_or(CutOff)?;
        self.bytes = rest;
        Ok(list)
    }
}

/// A hash of bytes that notices any changed one (FNV-1a, 64 bits).
#[derive(Clone, Copy, Debug)]
pub(super) struct Hash(pub(super) u64);

impl Default for Hash {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Hash {
    pub(super) fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
}

impl std::fmt::Write for Hash {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.add(text.as_bytes());
        Ok(())
    }
}
