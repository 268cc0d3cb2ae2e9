//! 3MF: a zip archive with one object in millimetres.

use super::text::TextWriter;
use super::{EncodeError, OutputFormat};
use pompeiu_core::TriMesh;
use std::io::{self, Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const TYPES: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\
<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

const RELATIONSHIPS: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\
</Relationships>\n";

const BEGINNING: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
<resources><object id=\"1\" type=\"model\"><mesh>\n<vertices>\n";

const END: &str =
    "</triangles>\n</mesh></object></resources>\n<build><item objectid=\"1\"/></build>\n</model>\n";

/// Compressed in memory: the directory of the archive holds lengths and sums, which are known at the end of each part.
pub(super) fn write(mut out: impl Write, mesh: &TriMesh) -> Result<(), EncodeError> {
    if mesh.faces().iter().any(|[a, b, c]| a == b || b == c || c == a) {
        let attribute = "faces that have a vertex twice; `repair` removes them";
        return Err(EncodeError::Unsupported { format: OutputFormat::ThreeMf, attribute });
    }
    // The time of each part is that of no clock: the same mesh gives the same file.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::DEFAULT);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONSHIPS)] {
        archive.start_file(name, options).map_err(io::Error::from)?;
        archive.write_all(text.as_bytes())?;
    }
    archive.start_file("3D/3dmodel.model", options.large_file(true)).map_err(io::Error::from)?;
    write_model(&mut archive, mesh)?;
    let archive = archive.finish().map_err(io::Error::from)?;
    Ok(out.write_all(&archive.into_inner())?)
}

fn write_model(out: impl Write, mesh: &TriMesh) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text(BEGINNING);
    for [x, y, z] in mesh.positions() {
        for (name, value) in [("<vertex x=\"", x), ("\" y=\"", y), ("\" z=\"", z)] {
            text.text(name);
            text.real(*value);
        }
        text.text("\"/>");
        text.end_line()?;
    }
    text.text("</vertices>\n<triangles>\n");
    for [a, b, c] in mesh.faces() {
        for (name, v) in [("<triangle v1=\"", a), ("\" v2=\"", b), ("\" v3=\"", c)] {
            text.text(name);
            text.integer(*v);
        }
        text.text("\"/>");
        text.end_line()?;
    }
    text.text(END);
    text.flush()
}
