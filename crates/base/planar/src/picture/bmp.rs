//! Windows bitmaps without compression, of 1, 4, 8, 24 and 32 bits.

use super::{PictureError, PictureFormat, Pixels, Samples, pixels};

/// Size of the file header, before the header of the bitmap.
const FILE_HEADER: usize = 14;

pub(super) fn read(bytes: &[u8]) -> Result<Pixels, PictureError> {
    let wrong = |why: &str| PictureError::Damaged { format: PictureFormat::Bmp, why: why.to_owned() };
    let short = || wrong("it is cut off");
    let u32_at = |at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?))
    };
    let u16_at = |at: usize| Some(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?));
    let data = u32_at(10).ok_or_else(short)? as usize;
    let header = u32_at(FILE_HEADER).ok_or_else(short)? as usize;
    if header < 40 {
        return Err(wrong("its header is that of OS/2; write it anew as a Windows bitmap"));
    }
    let width = u32_at(18).ok_or_else(short)?.cast_signed();
    let height = u32_at(22).ok_or_else(short)?.cast_signed();
    let bits = usize::from(u16_at(28).ok_or_else(short)?);
    let compression = u32_at(30).ok_or_else(short)?;
    if width < 0 {
        return Err(wrong("its width is negative"));
    }
    // Compression 3 means colour masks; for 32 bits they nearly always state the usual order.
    if !(compression == 0 || (compression == 3 && bits == 32)) || ![1, 4, 8, 24, 32].contains(&bits) {
        return Err(wrong(&format!(
            "it has {bits} bits a pixel and compression {compression}; 1, 4, 8, 24 and 32 bits without compression are read"
        )));
    }
    let (across, rows) = (width.unsigned_abs(), height.unsigned_abs());
    let count = pixels(across.into(), rows.into())?;
    let (across, rows) = (across as usize, rows as usize);
    let stride = (across * bits).div_ceil(32) * 4;
    let content =
        bytes.get(data..).and_then(|rest| rest.get(..stride.checked_mul(rows)?)).ok_or_else(short)?;
    let colours = match u32_at(46).ok_or_else(short)? as usize {
        _ if bits > 8 => 0,
        0 => 1 << bits,
        used => used.min(1 << bits),
    };
    let table_start = FILE_HEADER.checked_add(header).ok_or_else(short)?;
    let table = bytes.get(table_start..).and_then(|rest| rest.get(..4 * colours)).ok_or_else(short)?;
    let mut found = Vec::with_capacity(count);
    for row in 0..rows {
        // Rows go from bottom to top, unless the height is negative.
        let line = if height < 0 { row } else { rows - 1 - row };
        let line = &content[line * stride..(line + 1) * stride];
        for column in 0..across {
            let entry = match bits {
                1 => Some(line[column / 8] >> (7 - column % 8) & 1),
                4 => Some(line[column / 2] >> (4 * (1 - column % 2)) & 15),
                8 => Some(line[column]),
                _ => None,
            };
            let bgr = match entry {
                Some(entry) => table.get(4 * usize::from(entry)..4 * usize::from(entry) + 3),
                None => line.get(column * bits / 8..column * bits / 8 + 3),
            };
            let bgr = bgr.ok_or_else(|| wrong("a pixel names a colour that its table lacks"))?;
            found.push([bgr[2], bgr[1], bgr[0], u8::MAX]);
        }
    }
    Pixels::of_size(across, rows, Samples::Eight(found), false).ok_or_else(short)
}
