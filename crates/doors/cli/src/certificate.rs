//! Certificates beside an answer: written, whole or not at all, and told.

use crate::door::Session;
use crate::files;
use crate::page::Page;
use anyhow::{Context, bail};
use bytesize::ByteSize;
use pompeiu::core::TriMesh;
use pompeiu::hausdorff::VerifyRequest;
use pompeiu::hausdorff::certificate::{
    AttachedProof, Certificate, CertificateAnswer, CertificateError, CertificateOptions, Certified, Goal,
    write_certificate, write_packed,
};
use std::fs::File;
use std::io::{BufReader, Write};
use std::path::Path;

/// Writes a certificate by a function that streams it, within the limits of the command. Those on time count anew: a search that used
/// all of its time leaves an answer that can be certified.
pub(crate) fn write(
    path: &Path,
    session: &Session<'_>,
    fill: impl FnOnce(&CertificateOptions, &mut (dyn Write + Send)) -> Result<Certificate, CertificateError>,
) -> anyhow::Result<CertificateAnswer> {
    session.wait.show(format!("writing {}", path.display()));
    let options = CertificateOptions { limits: session.limits_anew() };
    let attempt = pompeiu::io::write_stream(path, |into| write_packed(into, |into| fill(&options, into)));
    let answer = CertificateAnswer::of(attempt).with_context(|| path.display().to_string())?;
    if let Some(problem) = &answer.problem {
        session.wait.suspend(|| {
            session
                .printer
                .warning(format_args!("{}: no certificate was written: {problem}", path.display()));
        });
    }
    Ok(answer)
}

/// Refuses a certificate of a result for which nothing is to be proven, or whose file has other coordinates than what was measured.
pub(crate) fn check_result(
    path: Option<&Path>,
    asks_for_distance: bool,
    is_centered: bool,
) -> anyhow::Result<()> {
    if path.is_some() && !asks_for_distance {
        bail!(
            "--certificate proves how far the result is from the input; say with --within how far it may be"
        );
    }
    if path.is_some() && is_centered {
        bail!(
            "a certificate is about the triangles in the files, but --center moves those of the result; leave one of both out"
        );
    }
    Ok(())
}

/// Writes a certificate that no point of a mesh is farther from the other than a length, in both directions.
pub(crate) fn write_within(
    path: &Path,
    [input, result]: [&TriMesh; 2],
    within: f64,
    session: &Session<'_>,
) -> anyhow::Result<CertificateAnswer> {
    let goals = [Some(Goal::within(within)); 2];
    write(path, session, |options, into| write_certificate(input, result, goals, options, into))
}

/// Writes a certificate as [`write_within`] does, of what an output holds, read again, which is returned, too: a format may have an order of
/// faces of its own.
pub(crate) fn write_of_output(
    path: &Path,
    input: &TriMesh,
    output: &Path,
    within: f64,
    session: &Session<'_>,
) -> anyhow::Result<(CertificateAnswer, TriMesh)> {
    let result = files::read(output)?.mesh;
    Ok((write_within(path, [input, &result], within, session)?, result))
}

/// Checks a certificate that was written, for what is shown beside it. None where none was written.
pub(crate) fn attached(
    path: &Path,
    [a, b]: [&TriMesh; 2],
    answer: &CertificateAnswer,
    session: &Session<'_>,
) -> anyhow::Result<Option<AttachedProof>> {
    let Some(certificate) = answer.written.clone() else { return Ok(None) };
    session.wait.show(format!("checking {}", path.display()));
    let context = || path.display().to_string();
    let threads = session.limits_anew().threads.or_else(|| std::thread::available_parallelism().ok());
    let file = BufReader::new(File::open(path).with_context(context)?);
    let found = VerifyRequest {}.run(a, b, file, threads.map_or(1, usize::from)).with_context(context)?;
    if let Some(failure) = found.failure {
        bail!("{}: the certificate that was written is not valid: {}", path.display(), failure.message);
    }
    let sha256 = files::sha256(path).with_context(context)?;
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Some(AttachedProof { file, sha256, certificate }))
}

/// What a certificate proves, and where it is.
pub(crate) fn rows(page: &mut Page, path: &Path, answer: &CertificateAnswer) {
    let Some(written) = &answer.written else {
        page.row("proof", "not written, see the warning");
        return;
    };
    page.row(
        "proof",
        &format!("{}, {}; `pompeiu verify` checks it", path.display(), ByteSize(written.bytes)),
    );
    proven(page, written.a_to_b.as_ref(), written.b_to_a.as_ref());
}

/// The rows of [`rows`], after a text that is no page.
pub(crate) fn text(path: &Path, answer: &CertificateAnswer) -> String {
    let mut page = Page::new();
    rows(&mut page, path, answer);
    page.into_text()
}

/// A row for each direction.
pub(crate) fn proven(page: &mut Page, a_to_b: Option<&Certified>, b_to_a: Option<&Certified>) {
    for (name, claim) in [("h(A, B)", a_to_b), ("h(B, A)", b_to_a)] {
        if let Some(Certified { lower, upper, .. }) = claim {
            page.row("", &format!("{lower} <= {name} <= {upper}"));
        }
    }
}
