//! Certificates of what a request found.

use super::{Certificate, CertificateError, CertificateOptions, Goal, write_certificate};
use crate::request::{Comparison, DeviationReport, DirectedDistance, DistanceReport};
use crate::tolerance::check_slack;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use std::io::Write;

/// The diagonal of the box around both meshes.
fn diagonal(meshes: [&TriMesh; 2]) -> f64 {
    meshes.map(Aabb::of_faces).into_iter().fold(Aabb::EMPTY, Aabb::union).diagonal()
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
