//! VTK's XML around the arrays of a data set, and the list of a series of such files.
//!
//! A file describes its arrays first; their bytes follow as one block, little-endian, each array behind its length.

use std::collections::VecDeque;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Size of the byte count that precedes each appended array, by `header_type="UInt64"`.
const LENGTH_BYTES: u64 = 8;

/// Bytes that are collected before they are written, since a writer may not be buffered.
const BUFFER_BYTES: usize = 1 << 16;

/// A kind of data set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataSet {
    /// Polygons with shared vertices.
    PolyData,
    /// Cells of any kind.
    UnstructuredGrid,
}

impl DataSet {
    fn name(self) -> &'static str {
        match self {
            Self::PolyData => "PolyData",
            Self::UnstructuredGrid => "UnstructuredGrid",
        }
    }
}

/// The description of a VTK XML file with raw appended arrays; [`VtkFile::arrays`] continues with the arrays.
#[derive(Debug)]
pub struct VtkFile {
    xml: String,
    data_set: DataSet,
    /// Lengths of the arrays described so far, in bytes.
    lengths: VecDeque<u64>,
    end: u64,
}

impl VtkFile {
    /// A file of this version of the format ("1.0", "2.2") with one piece, whose attributes are `counts`
    /// (`NumberOfPoints="3" NumberOfPolys="1"`).
    pub fn new(version: &str, data_set: DataSet, counts: &str) -> Self {
        let name = data_set.name();
        let xml = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"{name}\" version=\"{version}\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <{name}>\n\
             <Piece {counts}>\n"
        );
        Self { xml, data_set, lengths: VecDeque::new(), end: 0 }
    }

    /// Opens an element, given with its attributes.
    pub fn open(&mut self, tag: &str) {
        self.xml.extend(["<", tag, ">\n"]);
    }

    /// Closes an element.
    pub fn close(&mut self, tag: &str) {
        self.xml.extend(["</", tag, ">\n"]);
    }

    /// Describes the next array: its name, VTK's name of its numbers, how many of them an entry has, its length in bytes. The name must
    /// not need escaping.
    pub fn array(&mut self, name: &str, kind: &str, components: usize, bytes: u64) {
        let offset = self.end;
        self.end += LENGTH_BYTES + bytes;
        self.lengths.push_back(bytes);
        // Writing to a string does not fail.
        let _ = writeln!(
            self.xml,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>"
        );
    }

    /// Writes the description. The arrays follow in the order in which they were described.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn arrays<W: Write>(self, mut out: W) -> io::Result<Arrays<W>> {
        let name = self.data_set.name();
        out.write_all(self.xml.as_bytes())?;
        write!(out, "</Piece>\n</{name}>\n<AppendedData encoding=\"raw\">\n_")?;
        Ok(Arrays { out, lengths: self.lengths, buffer: Vec::new() })
    }
}

/// A VTK XML file whose description is written.
#[derive(Debug)]
pub struct Arrays<W> {
    out: W,
    lengths: VecDeque<u64>,
    buffer: Vec<u8>,
}

impl<W: Write> Arrays<W> {
    /// Writes the next array.
    ///
    /// # Errors
    /// Those of the writer; [`io::ErrorKind::InvalidInput`] if the values are not as long as the array was described.
    pub fn append<const N: usize>(&mut self, values: impl IntoIterator<Item = [u8; N]>) -> io::Result<()> {
        let described = self.lengths.pop_front().unwrap_or(0);
        self.out.write_all(&described.to_le_bytes())?;
        let mut written = 0;
        for value in values {
            self.buffer.extend_from_slice(&value);
            written += N as u64;
            if self.buffer.len() >= BUFFER_BYTES {
                self.flush()?;
            }
        }
        self.flush()?;
        if written != described {
            let message = format!("an array was described with {described} bytes and has {written}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.write_all(&self.buffer)?;
        self.buffer.clear();
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn finish(mut self) -> io::Result<()> {
        self.out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    }
}

/// The list of the files of a series with their times (`.pvd`), as ParaView reads it.
pub fn series(files: impl IntoIterator<Item = (f64, String)>) -> String {
    let mut list = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
    );
    for (time, file) in files {
        let file = file.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let _ = writeln!(list, "    <DataSet timestep=\"{time}\" file=\"{file}\"/>");
    }
    list.push_str("  </Collection>\n</VTKFile>\n");
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_follow_their_description_behind_their_lengths() {
        let mut file = VtkFile::new("1.0", DataSet::PolyData, "NumberOfPoints=\"2\"");
        file.array("first", "Float64", 1, 16);
        file.array("second", "UInt8", 3, 3);
        let mut bytes = Vec::new();
        let mut arrays = file.arrays(&mut bytes).unwrap();
        arrays.append([1.0_f64, 2.0].map(f64::to_le_bytes)).unwrap();
        arrays.append([[7_u8, 8, 9]]).unwrap();
        arrays.finish().unwrap();
        let text = String::from_utf8_lossy(&bytes).into_owned();
        assert!(text.contains("Name=\"second\" NumberOfComponents=\"3\" format=\"appended\" offset=\"24\""));
        let start = bytes.windows(2).position(|pair| pair == b"\n_").unwrap() + 2;
        assert_eq!(bytes[start..start + 8], 16_u64.to_le_bytes());
        assert_eq!(bytes[start + 24..start + 35], [3, 0, 0, 0, 0, 0, 0, 0, 7, 8, 9]);
    }

    #[test]
    fn an_array_of_another_length_is_an_error() {
        let mut file = VtkFile::new("1.0", DataSet::PolyData, "");
        file.array("first", "UInt8", 1, 2);
        let mut arrays = file.arrays(Vec::new()).unwrap();
        assert_eq!(arrays.append([[1_u8]]).unwrap_err().kind(), io::ErrorKind::InvalidInput);
    }

    #[test]
    fn names_of_files_are_escaped() {
        assert!(
            series([(0.5, "a&b\"/s.vtp".to_owned())])
                .contains("timestep=\"0.5\" file=\"a&amp;b&quot;/s.vtp\"")
        );
    }
}
