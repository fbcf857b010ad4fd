//! Bugs to seed: what the audit must be able to find.
//!
//! `etendue-mutations` puts each into a copy of the workspace, builds the audit and runs it. Adding
//! one: an entry in the file of its family. The text to find must occur exactly once in its file; a
//! test says so when a change of the sources makes an entry stale.

mod adapter;
mod diffuse;
mod fresnel;
mod layered;
mod measured;
mod microfacet;
mod openpbr;
mod phong;
mod principled;
mod radiometry;
mod rough;
mod sampling;
mod smooth;
mod walks;

/// A bug and where to put it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mutation {
    /// What is wrong, in a few words.
    pub fault: &'static str,
    /// The file, from the root of the workspace.
    pub file: &'static str,
    /// The text to find.
    pub find: &'static str,
    /// The text in its place.
    pub replace: &'static str,
    /// What of the audit is run: models and checks as `--filter` names them.
    pub filters: &'static [&'static str],
}

/// All of them, by family.
pub fn all() -> Vec<Mutation> {
    [
        sampling::MUTATIONS,
        fresnel::MUTATIONS,
        microfacet::MUTATIONS,
        walks::MUTATIONS,
        diffuse::MUTATIONS,
        smooth::MUTATIONS,
        rough::MUTATIONS,
        layered::MUTATIONS,
        openpbr::MUTATIONS,
        phong::MUTATIONS,
        principled::MUTATIONS,
        measured::MUTATIONS,
        adapter::MUTATIONS,
        radiometry::MUTATIONS,
    ]
    .concat()
}
