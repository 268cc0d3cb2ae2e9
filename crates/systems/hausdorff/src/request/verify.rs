//! Checking a certificate of a distance.

use crate::certificate::Certified;
use crate::report::Direction;
use pompeiu_core::TriMesh;
use pompeiu_core::request::{Conclusion, Limit, Report, Request, hexadecimal};
use pompeiu_core::run::StopReason;
use pompeiu_verify::{Claim, Rejected, Soup, verify};
use std::io::Read;

/// Check a certificate: whether it proves what it states of two meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerifyRequest {}

impl Request for VerifyRequest {
    const NAME: &'static str = "verify";
    const LIMITS: &'static [Limit] = &[Limit::Threads];
    type Report = VerifyReport;
}

/// The bounds that a certificate proves, or the first statement in it that does not hold. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerifyReport {
    /// Whether everything that it states is shown.
    pub valid: bool,
    /// The proven bound of h(A, B); null if none is stated, or if the certificate is not valid.
    pub a_to_b: Option<Certified>,
    /// The proven bound of h(B, A); null if none is stated, or if the certificate is not valid.
    pub b_to_a: Option<Certified>,
    /// SHA-256 of the triangles of A and of B in hexadecimal digits; null if the certificate is not valid.
    pub sha256: Option<[String; 2]>,
    /// The first statement that is not shown; null if all are.
    pub failure: Option<UnprovenStatement>,
}

/// A statement of a certificate that is not shown.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnprovenStatement {
    /// Its subject.
    pub statement: Statement,
    /// The direction that it is about; null of a mesh.
    pub direction: Option<Direction>,
    /// The face of the witness or of the cell, in the mesh that distances are measured from; null where there is none.
    pub face: Option<u32>,
    /// Cells of this face before the one that is not near enough; null where there is none.
    pub cell: Option<u64>,
    /// The face of the other mesh that is not shown to be near or far enough; null where there is none.
    pub other_face: Option<u32>,
    /// The same as a sentence.
    pub message: String,
}

/// The subject of a statement of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Statement {
    /// That A is the mesh that was certified.
    HashOfA,
    /// That B is the mesh that was certified.
    HashOfB,
    /// That the ends of an interval are lengths.
    Interval,
    /// That the witness is far enough from a face.
    Witness,
    /// That a cell is near enough to a face.
    Cell,
}

impl Report for VerifyReport {
    fn stop(&self) -> StopReason {
        StopReason::Tolerance
    }

    fn conclusion(&self) -> Conclusion {
        if self.valid { Conclusion::AsAsked } else { Conclusion::Refuted }
    }
}

impl VerifyRequest {
    /// Checks a certificate by [`pompeiu_verify`], on so many threads; nothing of the search is used.
    ///
    /// # Errors
    /// [`Rejected`] if what is read is no certificate, of another version, cut off, or cannot be read: [`Rejected::is_unreadable`].
    pub fn run(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        certificate: impl Read + Send,
        threads: usize,
    ) -> Result<VerifyReport, Rejected> {
        let [soup_a, soup_b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()));
        let Some((soup_a, soup_b)) = soup_a.zip(soup_b) else {
            // A mesh has faces and finite positions, but may have more faces than a certificate can name.
            return Err(Rejected::Malformed { found: "fewer bits for a face than the meshes need", byte: 0 });
        };
        match verify(&soup_a, &soup_b, certificate, threads) {
            Ok(verified) => {
                let certified =
                    |claim: Claim| Certified { lower: claim.lower, upper: claim.upper, cells: claim.cells };
                let [a_to_b, b_to_a] = verified.claims.map(|claim| claim.map(certified));
                let sha256 = Some(verified.hashes.map(|hash| hexadecimal(&hash)));
                Ok(VerifyReport { valid: true, a_to_b, b_to_a, sha256, failure: None })
            }
            Err(error) if error.is_unreadable() => Err(error),
            Err(error) => {
                let failure = Some(UnprovenStatement::of(&error));
                Ok(VerifyReport { valid: false, a_to_b: None, b_to_a: None, sha256: None, failure })
            }
        }
    }
}

impl UnprovenStatement {
    fn of(rejected: &Rejected) -> Self {
        let direction = Some(Direction::AToB);
        let nothing = Self {
            statement: Statement::Interval,
            direction,
            face: None,
            cell: None,
            other_face: None,
            message: rejected.to_string(),
        };
        match rejected {
            Rejected::Hash(0) => Self { statement: Statement::HashOfA, direction: None, ..nothing },
            Rejected::Hash(_) => Self { statement: Statement::HashOfB, direction: None, ..nothing },
            Rejected::Witness(witness, other) => Self {
                statement: Statement::Witness,
                face: Some(witness.face),
                other_face: Some(*other),
                ..nothing
            },
            Rejected::Cell { face, cell, of_b } => Self {
                statement: Statement::Cell,
                face: Some(*face),
                cell: Some(*cell),
                other_face: Some(*of_b),
                ..nothing
            },
            Rejected::Reversed(inner) => {
                Self { direction: Some(Direction::BToA), message: nothing.message.clone(), ..Self::of(inner) }
            }
            Rejected::Claim(..) | Rejected::Malformed { .. } | Rejected::Io(_) => nothing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{CertificateOptions, Goal, write_certificate};
    use pompeiu_core::mesh::shapes::{icosphere, torus};

    /// A certificate with both directions, and the bytes at which each part of the first one stands.
    fn written(a: &TriMesh, b: &TriMesh) -> Vec<u8> {
        let report = crate::symmetric_hausdorff(a, b);
        let mut bytes = Vec::new();
        let goals = Goal::of_both(&report, 1e-9);
        write_certificate(a, b, goals, &CertificateOptions::default(), &mut bytes).unwrap();
        bytes
    }

    #[test]
    fn the_statement_that_fails_is_named() {
        let (a, b) = (icosphere(1.0, 1).unwrap(), torus(0.8, 0.5, 12, 9).unwrap());
        let bytes = written(&a, &b);
        let check = |bytes: &[u8]| VerifyRequest {}.run(&a, &b, bytes, 2);
        let good = check(&bytes).unwrap();
        assert!(good.valid && good.a_to_b.is_some() && good.b_to_a.is_some() && good.failure.is_none());
        let with = |at: usize, number: f64| {
            let mut forged = bytes.clone();
            forged[at..at + 8].copy_from_slice(&number.to_le_bytes());
            check(&forged).unwrap().failure.unwrap()
        };
        let claims = good.a_to_b.unwrap();
        let witness = with(73, 1.01 * claims.lower);
        assert_eq!((witness.statement, witness.direction), (Statement::Witness, Some(Direction::AToB)));
        assert!(witness.face.is_some() && witness.other_face.is_some() && witness.cell.is_none());
        let cell = with(81, 0.5 * claims.upper);
        assert!(cell.statement == Statement::Cell && cell.cell.is_some() && cell.face.is_some());
        assert_eq!(with(73, -1.0).statement, Statement::Interval);
        let other = VerifyRequest {}.run(&a, &a, &bytes[..], 1).unwrap().failure.unwrap();
        assert_eq!((other.statement, other.direction), (Statement::HashOfB, None));
        let length = u32::from_le_bytes(bytes[117..121].try_into().unwrap()) as usize;
        let back = with(121 + length + 8, 0.5 * good.b_to_a.unwrap().upper);
        assert_eq!((back.statement, back.direction), (Statement::Cell, Some(Direction::BToA)));
        assert!(check(&bytes[..80]).unwrap_err().is_unreadable());
    }
}
