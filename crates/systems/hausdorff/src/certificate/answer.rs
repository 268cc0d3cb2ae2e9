//! What is said of a certificate.

use super::{Certificate, CertificateError};

/// The outcome of a certificate that was requested.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CertificateAnswer {
    /// The bounds that it proves; null where none was written.
    pub written: Option<Certificate>,
    /// The reason for which none was written; null where one was.
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
