//! Number types in VTK files.

/// The byte order of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByteOrder {
    Little,
    Big,
}

/// The type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl NumberType {
    /// The type with this name in legacy files, in lower case.
    pub(super) fn from_legacy_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "signed_char" => Self::I8,
            "unsigned_char" => Self::U8,
            "short" => Self::I16,
            "unsigned_short" => Self::U16,
            // Files store ids in 32 bits, whatever the build of the program that wrote them.
            "int" | "vtkidtype" => Self::I32,
            "unsigned_int" => Self::U32,
            "long" | "vtktypeint64" => Self::I64,
            "unsigned_long" | "vtktypeuint64" => Self::U64,
            "float" => Self::F32,
            "double" => Self::F64,
            _ => return None,
        })
    }

    /// The type with this name in XML files.
    pub(super) fn from_xml_name(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::I8,
            "UInt8" => Self::U8,
            "Int16" => Self::I16,
            "UInt16" => Self::U16,
            "Int32" => Self::I32,
            "UInt32" => Self::U32,
            "Int64" => Self::I64,
            "UInt64" => Self::U64,
            "Float32" => Self::F32,
            "Float64" => Self::F64,
            _ => return None,
        })
    }

    /// The size in bytes.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number stored in `bytes`, which holds [`size`](Self::size) bytes.
    pub(super) fn real(self, bytes: &[u8], order: ByteOrder) -> f64 {
        let word = word(bytes, order);
        match self {
            Self::F32 => f32::from_bits(word as u32).into(),
            Self::F64 => f64::from_bits(word),
            Self::U8 | Self::U16 | Self::U32 | Self::U64 => word as f64,
            Self::I8 | Self::I16 | Self::I32 | Self::I64 => self.signed(word) as f64,
        }
    }

    /// The number stored in `bytes`, if it is a nonnegative integer.
    pub(super) fn count(self, bytes: &[u8], order: ByteOrder) -> Option<u64> {
        let word = word(bytes, order);
        match self {
            Self::U8 | Self::U16 | Self::U32 | Self::U64 => Some(word),
            Self::I8 | Self::I16 | Self::I32 | Self::I64 => u64::try_from(self.signed(word)).ok(),
            Self::F32 | Self::F64 => None,
        }
    }

    const fn signed(self, word: u64) -> i64 {
        let unused = 64 - 8 * self.size() as u32;
        (word << unused).cast_signed() >> unused
    }
}

fn word(bytes: &[u8], order: ByteOrder) -> u64 {
    let append = |word: u64, byte: &u8| word << 8 | u64::from(*byte);
    match order {
        ByteOrder::Little => bytes.iter().rev().fold(0, append),
        ByteOrder::Big => bytes.iter().fold(0, append),
    }
}
