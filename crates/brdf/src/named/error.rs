//! Why something could not be built by name.

use alloc::string::String;
use alloc::vec::Vec;
use core::error::Error;
use core::fmt;

use crate::ParameterError;

/// What is wrong with a description.
#[derive(Clone, Debug, PartialEq)]
pub enum NamedError {
    /// Nothing has this name.
    Unknown {
        /// The name.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// A parameter nobody asks for.
    UnknownParameter {
        /// Whose it would be.
        of: &'static str,
        /// Its name.
        parameter: String,
        /// The names that are accepted.
        known: Vec<&'static str>,
    },
    /// A parameter without which there is no model.
    Missing {
        /// Whose it is.
        of: &'static str,
        /// Its name.
        parameter: &'static str,
    },
    /// A value of the wrong kind: a word for a number, an unknown choice.
    Kind {
        /// Whose it is.
        of: &'static str,
        /// Its name.
        parameter: &'static str,
        /// What is accepted, in words.
        expected: String,
    },
    /// A number outside its domain.
    Domain {
        /// Whose it is.
        of: &'static str,
        /// Name, value and domain.
        error: ParameterError,
    },
}

impl fmt::Display for NamedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name, known } => {
                write!(f, "there is no {name:?}; known are {}", known.join(", "))
            }
            Self::UnknownParameter { of, parameter, known } if known.is_empty() => {
                write!(f, "{of} has no parameter {parameter:?}, nor any other")
            }
            Self::UnknownParameter { of, parameter, known } => {
                write!(f, "{of} has no parameter {parameter:?}; it takes {}", known.join(", "))
            }
            Self::Missing { of, parameter } => write!(f, "{of} needs the parameter {parameter:?}"),
            Self::Kind { of, parameter, expected } => {
                write!(f, "{of}: {parameter} must be {expected}")
            }
            Self::Domain { of, error } => write!(f, "{of}: {error}"),
        }
    }
}

impl Error for NamedError {}
