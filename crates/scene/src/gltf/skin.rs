//! Skins: meshes that hang on joints, as these are at rest.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::vec::Vec;

use etendue_math::glam::{DAffine3, DMat3, DMat4, DVec3, Vec3};

use super::accessor::Accessor;
use super::buffers::Buffers;
use super::json::Json;
use super::node::Node;
use crate::SceneError;

/// Where each joint takes a mesh from the pose that it was modelled in: to the world.
#[derive(Clone, Debug)]
pub(super) struct Skin {
    joints: Vec<DAffine3>,
}

/// The joints of a vertex, four in each of some sets, and how much it hangs on each.
pub(super) struct Influences {
    joints: Vec<[f32; 4]>,
    weights: Vec<[f32; 4]>,
}

/// The skin of a node, if it has one; `places` are those of all nodes of the scene.
///
/// # Errors
/// A skin that does not exist, joints that are no part of the scene, fewer matrices than joints.
pub(super) fn of(
    buffers: &Buffers<'_>,
    node: &Node<'_>,
    places: &BTreeMap<usize, DAffine3>,
) -> Result<Option<Skin>, SceneError> {
    let Some((_, json)) = buffers.document().named(&node.json, "skin", "skins")? else {
        return Ok(None);
    };
    let mut joints = Vec::new();
    for joint in json.items("joints")? {
        let index = joint.as_index()?;
        let Some(place) = places.get(&index) else {
            return Err(joint.error(format!("nodes[{index}] is no part of the scene")));
        };
        joints.push(*place);
    }
    buffers.spend(joints.len() as u64, &json)?;
    if let Some(matrices) = Accessor::named(buffers, &json, "inverseBindMatrices")? {
        if matrices.len() < joints.len() {
            let message =
                format!("{} matrices are too few for {} joints", matrices.len(), joints.len());
            return Err(matrices.error(message));
        }
        for (joint, matrix) in joints.iter_mut().zip(matrices.vectors::<16>(&[16], 0.0)?) {
            let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
            *joint *= DAffine3::from_mat4(matrix);
        }
    }
    Ok(Some(Skin { joints }))
}

impl Skin {
    /// How vertices hang on the joints, one set of four after another.
    ///
    /// # Errors
    /// Joints without weights, or another number of them than of vertices; a joint that the skin does not have.
    pub(super) fn influences(
        &self,
        buffers: &Buffers<'_>,
        attributes: &Json<'_>,
        vertices: usize,
    ) -> Result<Vec<Influences>, SceneError> {
        let mut sets = Vec::new();
        for set in 0.. {
            let name = format!("JOINTS_{set}");
            let Some(joints) = Accessor::named(buffers, attributes, &name)? else { break };
            let weights = Accessor::named(buffers, attributes, &format!("WEIGHTS_{set}"))?;
            let Some(weights) = weights else {
                return Err(attributes.error(format!("has {name} without WEIGHTS_{set}")));
            };
            for list in [&joints, &weights] {
                if list.len() != vertices {
                    let message = format!("has {} elements for {vertices} positions", list.len());
                    return Err(list.error(message));
                }
            }
            let numbers = joints.vectors::<4>(&[4], 0.0)?;
            let there = |joint: &f32| *joint >= 0.0 && (*joint as usize) < self.joints.len();
            if let Some(joint) = numbers.iter().flatten().find(|joint| !there(joint)) {
                let count = self.joints.len();
                return Err(
                    joints.error(format!("there is no joint {joint}, the skin has {count}"))
                );
            }
            sets.push(Influences { joints: numbers, weights: weights.vectors::<4>(&[4], 0.0)? });
        }
        if sets.is_empty() {
            return Err(attributes.error("has no JOINTS_0, but its node has a skin"));
        }
        Ok(sets)
    }

    /// Takes vertices to the world.
    ///
    /// ```text
    /// p' = M p,  n' ∝ M⁻ᵀ n,  M = Σ w J / Σ w
    /// ```
    ///
    /// # Source
    /// glTF 2.0, section 3.7.3.
    pub(super) fn pose(&self, sets: &[Influences], positions: &mut [Vec3], normals: &mut [Vec3]) {
        for (vertex, position) in positions.iter_mut().enumerate() {
            let influences =
                sets.iter().flat_map(|set| set.joints[vertex].into_iter().zip(set.weights[vertex]));
            let nowhere = (DMat3::ZERO, DVec3::ZERO, 0.0);
            let (linear, offset, sum) =
                influences.fold(nowhere, |(linear, offset, sum), (joint, weight)| {
                    let (joint, weight) = (&self.joints[joint as usize], f64::from(weight));
                    let offset = offset + joint.translation * weight;
                    (linear + joint.matrix3 * weight, offset, sum + weight)
                });
            // A vertex that hangs on nothing stays where it is.
            if sum == 0.0 {
                continue;
            }
            let linear = linear * (1.0 / sum);
            *position = (linear * position.as_dvec3() + offset / sum).as_vec3();
            if let Some(normal) = normals.get_mut(vertex) {
                let turned = linear.inverse().transpose() * normal.as_dvec3();
                // Zero stands for the normal of the triangle.
                *normal = turned.try_normalize().unwrap_or(DVec3::ZERO).as_vec3();
            }
        }
    }
}
