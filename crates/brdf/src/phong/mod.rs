//! The Phong family: lobes that are powers of a cosine.

pub(crate) mod ashikhmin_shirley;
pub(crate) mod ashikhmin_shirley_diffuse;
pub(crate) mod ashikhmin_shirley_specular;
mod half_vectors;
pub(crate) mod modified_phong;

pub use ashikhmin_shirley::{AshikhminShirley, AshikhminShirleySampling};
pub use ashikhmin_shirley_diffuse::AshikhminShirleyDiffuse;
pub use ashikhmin_shirley_specular::AshikhminShirleySpecular;
pub use half_vectors::PhongHalfVectors;
pub use modified_phong::Phong;
