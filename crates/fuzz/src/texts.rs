//! Skeletons, drawings, pictures, files of options, and the files that the programs for neurons exchange.

use pompeiu::core::request::Request;
use pompeiu::hausdorff::{DistanceRequest, RepairRequest};
use pompeiu::matching::request::{AlignRequest, AlignedDistanceRequest};
use pompeiu::neuron::{Preparation, SwcRow, prepare, read_swc, read_transport_config, write_swc};
use pompeiu::options::{Options, options_of, options_of_toml, request_from};
use pompeiu::planar::picture::{ColourPicture, Picture};
use pompeiu::planar::silhouette::{SilhouetteOptions, silhouette};
use pompeiu::planar::{dxf, svg};
use pompeiu::volume::{UnstructuredSplines, read_bzmeshinfo, read_bzpt};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// Rows that are read are written and read back to the same bits; repairing ends.
pub(crate) fn skeleton(bytes: &[u8]) {
    if let Ok(rows) = read_swc(bytes) {
        let text = write_swc(&rows);
        let again = read_swc(text.as_bytes()).expect("what was written is read");
        // Comments are not kept, so that lines have other numbers.
        let bare =
            |rows: Vec<SwcRow>| rows.into_iter().map(|row| SwcRow { line: 0, ..row }).collect::<Vec<_>>();
        assert_eq!(bare(again), bare(rows));
    }
    drop(prepare(bytes, &Preparation { repair: true, ..Preparation::default() }));
}

/// SVG and DXF.
pub(crate) fn drawing(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    for read in [svg::read(text).ok(), dxf::read(text).ok()].into_iter().flatten() {
        assert!(read.iter().flat_map(|line| &line.points).flatten().all(|x| x.is_finite()));
    }
}

/// A size in a header takes no memory that the file does not fill.
pub(crate) fn picture(bytes: &[u8]) {
    drop(ColourPicture::read(bytes));
    let Ok(picture) = Picture::read(bytes) else { return };
    assert_eq!(picture.levels().len(), picture.width() * picture.height());
    if picture.levels().len() <= 1 << 16 {
        drop(silhouette(&picture, &SilhouetteOptions::default()));
    }
}

/// A request made from a file is made from its own options again.
pub(crate) fn options(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    drop(read_transport_config(text));
    let Ok(options) = options_of_toml(text) else { return };
    stays::<AlignedDistanceRequest>(&options);
    stays::<DistanceRequest>(&options);
    stays::<AlignRequest>(&options);
    stays::<RepairRequest>(&options);
}

fn stays<Q>(options: &Options)
where
    Q: Request + Serialize + DeserializeOwned + PartialEq + Debug,
{
    if let Ok(request) = request_from::<Q>(options.clone()) {
        assert_eq!(request_from::<Q>(options_of(&request)).as_ref(), Ok(&request));
    }
}

/// Control meshes, lists of elements and Bézier points as `NeuronTransportIGA` has them.
pub(crate) fn neuron_files(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    drop(UnstructuredSplines::from_cmat(text));
    drop(read_bzmeshinfo(text));
    drop(read_bzpt(text));
}
