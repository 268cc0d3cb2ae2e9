//! Certificates of what a request found.

use super::{Certificate, CertificateError, CertificateOptions, Goal, write_certificate};
use crate::request::{Comparison, DeviationReport, DirectedDistance, DistanceReport};
use crate::tolerance::OptionError;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use std::io::Write;

/// What came of a certificate that was asked for.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CertificateAnswer {
    /// What it proves; null where none was written.
    pub written: Option<Certificate>,
    /// Why none was written; null where one was.
    pub problem: Option<String>,
}

impl CertificateAnswer {
    /// What is said of an attempt to write a certificate. Only what concerns the file or the question is an error: the answer that was to be
    /// proven holds without a proof, too.
    ///
    /// # Errors
    /// [`CertificateError::Io`] and [`CertificateError::Option`].
    pub fn of(attempt: Result<Certificate, CertificateError>) -> Result<Self, CertificateError> {
        match attempt {
            Ok(certificate) => Ok(Self { written: Some(certificate), problem: None }),
            Err(error @ (CertificateError::Io(_) | CertificateError::Option(_))) => Err(error),
            Err(error) => Ok(Self { written: None, problem: Some(error.to_string()) }),
        }
    }
}

/// A certificate that lies beside a page or a document of the same answer, and was checked.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachedProof {
    /// The name of its file.
    pub file: String,
    /// SHA-256 of the file, in hexadecimal digits.
    pub sha256: String,
    /// What it proves.
    pub certificate: Certificate,
}

impl AttachedProof {
    /// What is said of it: names and values.
    pub fn rows(&self) -> Vec<[String; 2]> {
        let Self { file, sha256, certificate } = self;
        let checked = format!("{file}, checked with pompeiu-verify {}", env!("CARGO_PKG_VERSION"));
        let mut rows = vec![["proof attached".to_owned(), checked]];
        for (name, claim) in [("h(A, B)", &certificate.a_to_b), ("h(B, A)", &certificate.b_to_a)] {
            if let Some(claim) = claim {
                rows.push(["it proves".to_owned(), format!("{} <= {name} <= {}", claim.lower, claim.upper)]);
            }
        }
        let [a, b] = &certificate.sha256;
        rows.push(["SHA-256 of the proof".to_owned(), sha256.clone()]);
        rows.push(["SHA-256 of A's triangles".to_owned(), a.clone()]);
        rows.push(["SHA-256 of B's triangles".to_owned(), b.clone()]);
        rows.push(["check it again".to_owned(), format!("pompeiu verify {file} A B")]);
        rows
    }
}

/// # Errors
/// [`OptionError::Slack`] unless it is finite and not negative.
pub(crate) fn check_slack(slack: f64) -> Result<(), OptionError> {
    if (0.0..f64::INFINITY).contains(&slack) { Ok(()) } else { Err(OptionError::Slack(slack)) }
}

impl DistanceReport {
    /// Writes a certificate of the directions that were asked for.
    ///
    /// The upper ends are raised by `slack`, a fraction of the joint diagonal. Where the distance is proven to be at most a threshold, the
    /// threshold is the upper end, as it is what was asked.
    ///
    /// # Errors
    /// [`CertificateError`]; what was written by then is no certificate.
    pub fn certify(
        &self,
        meshes: [&TriMesh; 2],
        slack: f64,
        options: &CertificateOptions,
        into: &mut (dyn Write + Send),
    ) -> Result<Certificate, CertificateError> {
        check_slack(slack)?;
        let slack = slack * diagonal(meshes);
        let threshold = self.threshold.filter(|threshold| threshold.answer == Comparison::Below);
        let threshold = threshold.map(|threshold| threshold.value);
        let goals = [self.goal(false, slack, threshold), self.goal(true, slack, threshold)];
        write_certificate(meshes[0], meshes[1], goals, options, into)
    }

    fn goal(&self, is_reversed: bool, slack: f64, threshold: Option<f64>) -> Option<Goal> {
        let one: &DirectedDistance = if is_reversed { self.b_to_a.as_ref() } else { self.a_to_b.as_ref() }?;
        let from = if is_reversed { one.witness.b } else { one.witness.a };
        let upper = threshold.unwrap_or(one.distance.upper() + slack);
        Some(Goal { upper, witness: Some((from.face.0, from.barycentric, one.distance.lower())) })
    }
}

impl DeviationReport {
    /// Writes a certificate of the largest distances, both ways. Their upper ends are raised by [`Goal::SLACK`]; where they are at most the
    /// threshold, the threshold is the upper end, as it is what was asked.
    ///
    /// # Errors
    /// [`CertificateError`]; [`CertificateError::Parts`] where faces were left out. What was written by then is no certificate.
    pub fn certify(
        &self,
        meshes: [&TriMesh; 2],
        options: &CertificateOptions,
        into: &mut (dyn Write + Send),
    ) -> Result<Certificate, CertificateError> {
        if self.left_out.is_some() {
            return Err(CertificateError::Parts);
        }
        let slack = Goal::SLACK * diagonal(meshes);
        let threshold = self.threshold.filter(|threshold| self.deviation.distance.upper() <= *threshold);
        let both = [&self.deviation.a_to_b.distance, &self.deviation.b_to_a.distance];
        let goals = both.map(|found| {
            let goal = Goal::of(found, slack);
            Some(Goal { upper: threshold.unwrap_or(goal.upper), ..goal })
        });
        write_certificate(meshes[0], meshes[1], goals, options, into)
    }
}

/// The diagonal of the box around both meshes.
fn diagonal(meshes: [&TriMesh; 2]) -> f64 {
    meshes.map(Aabb::of_faces).into_iter().fold(Aabb::EMPTY, Aabb::union).diagonal()
}
