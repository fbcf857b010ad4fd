//! Vertices and faces of binary files, read on all cores straight into their arrays.
//!
//! What is read here has no flaw. Where there is one, or the records are of another kind, these functions answer `None` and the
//! reader of one number after the other finds out what to say.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::Vec3;
use rayon::prelude::*;

use super::attributes::Attributes;
use super::columns::Columns;
use super::header::{Element, Kind, Order, Scalar};
use super::{Faces, Vertices, is_indices};
use crate::load::mesh_file::TexCoords;
use crate::parallel;

/// How many records are a task.
const TASK: usize = 1 << 13;

/// A number's place in a record.
#[derive(Clone, Copy)]
struct Place {
    at: usize,
    kind: Scalar,
}

impl Place {
    #[inline(always)]
    fn read(self, record: &[u8], order: Order) -> f64 {
        record.get(self.at..).and_then(|bytes| order.number(self.kind, bytes)).unwrap_or(f64::NAN)
    }
}

/// The places of the properties, if they are all numbers, and the size of a record.
fn places(element: &Element) -> Option<(Vec<Place>, usize)> {
    let mut size = 0;
    let mut places = Vec::new();
    for property in &element.properties {
        let Kind::Scalar(kind) = property.kind else { return None };
        places.push(Place { at: size, kind });
        size += kind.size();
    }
    (size > 0).then_some((places, size))
}

/// The vertices and how many bytes they take.
pub(super) fn vertices(
    (bytes, order): (&[u8], Order),
    element: &Element,
    columns: &Columns,
    tex_coords: TexCoords,
    attributes: &mut Attributes,
) -> Option<(Vertices, usize)> {
    let (places, size) = places(element)?;
    let length = size.checked_mul(element.count)?;
    let records = bytes.get(..length)?.par_chunks_exact(size).with_min_len(TASK);
    let three = |slots: [usize; 3]| {
        let places = columns.only(slots)?.map(|column| places[column]);
        let vectors: Vec<Vec3> = vectors(&records, places, order, Vec3::from_array);
        parallel::position(&vectors, |v| !v.is_finite()).is_none().then_some(vectors)
    };
    let positions = three([0, 1, 2])?;
    let normals = if columns.has_normals { three([3, 4, 5])? } else { Vec::new() };
    let mut uvs = Vec::new();
    if columns.has_uvs {
        let places = columns.only([6, 7])?.map(|column| places[column]);
        uvs = vectors(&records, places, order, |uv| tex_coords.turn(uv.into()));
        if parallel::position(&uvs, |uv| !uv.is_finite()).is_some() {
            return None;
        }
    }
    attributes.collect(&records, |record, column| places[column].read(record, order));
    Some((Vertices { positions, normals, uvs }, length))
}

/// What `f` makes of `N` numbers of each record.
fn vectors<'a, const N: usize, T: Send>(
    records: &(impl IndexedParallelIterator<Item = &'a [u8]> + Clone),
    places: [Place; N],
    order: Order,
    f: impl Fn([f32; N]) -> T + Sync + Send,
) -> Vec<T> {
    let records = records.clone();
    if places.iter().any(|place| place.kind != Scalar::F32) {
        let read = |record: &[u8]| places.map(|place| place.read(record, order) as f32);
        return records.map(|record| f(read(record))).collect();
    }
    // Nearly always; without asking for the type of each number.
    let bytes = |record: &[u8], place: Place| {
        let bytes = record.get(place.at..).and_then(|rest| rest.first_chunk::<4>());
        bytes.copied().unwrap_or_default()
    };
    match order {
        Order::Little => records
            .map(|record| f(places.map(|place| f32::from_le_bytes(bytes(record, place)))))
            .collect(),
        Order::Big => records
            .map(|record| f(places.map(|place| f32::from_be_bytes(bytes(record, place)))))
            .collect(),
    }
}

/// A run of faces: their bytes and how many triangles they are.
struct Run<'a> {
    bytes: &'a [u8],
    triangles: usize,
}

/// Reads faces that are lists of vertices, with numbers before and after that are read over; returns how many have fewer than three
/// corners, and how many bytes all take.
pub(super) fn faces(
    (bytes, order): (&[u8], Order),
    element: &Element,
    vertices: usize,
    faces: &mut Faces<'_>,
) -> Option<(usize, usize)> {
    let face = Face::of(element, order)?;
    if !faces.attributes.is_empty() || vertices > u32::MAX as usize {
        return None;
    }
    let (mut rest, mut small, mut sum) = (bytes, 0, 0);
    let mut runs = Vec::new();
    let mut left = element.count;
    while left > 0 {
        let count = left.min(TASK);
        let (start, before) = (rest, sum);
        for _ in 0..count {
            let corners = face.corners(rest)?;
            rest = rest.get(face.size(corners)?..)?;
            sum += corners.saturating_sub(2);
            small += usize::from(corners < 3);
        }
        runs.push(Run { bytes: &start[..start.len() - rest.len()], triangles: sum - before });
        left -= count;
    }
    let mut triangles = vec![[0; 3]; sum];
    let mut places = triangles.as_mut_slice();
    let mut tasks = Vec::with_capacity(runs.len());
    for run in &runs {
        let (own, others) = places.split_at_mut(run.triangles);
        tasks.push((run.bytes, own));
        places = others;
    }
    tasks.into_par_iter().try_for_each(|(bytes, to)| face.fans(bytes, vertices as u32, to))?;
    *faces.triangles = triangles;
    Some((small, bytes.len() - rest.len()))
}

/// A face: numbers, the list of its vertices, more numbers.
struct Face {
    before: usize,
    length: Scalar,
    item: Scalar,
    after: usize,
    order: Order,
}

impl Face {
    fn of(element: &Element, order: Order) -> Option<Self> {
        let (mut before, mut after, mut list) = (0, 0, None);
        for property in &element.properties {
            match (property.kind, list) {
                (Kind::Scalar(scalar), None) => before += scalar.size(),
                (Kind::Scalar(scalar), Some(_)) => after += scalar.size(),
                (Kind::List { length, item }, None) if is_indices(&property.name) => {
                    list = Some((length, item));
                }
                (Kind::List { .. }, _) => return None,
            }
        }
        list.map(|(length, item)| Self { before, length, item, after, order })
    }

    /// How many corners the face has that some bytes begin with.
    #[inline(always)]
    fn corners(&self, bytes: &[u8]) -> Option<usize> {
        self.natural(self.length, bytes.get(self.before..)?).map(|n| n as usize)
    }

    /// The bytes of a face of so many corners.
    #[inline(always)]
    fn size(&self, corners: usize) -> Option<usize> {
        let list = corners.checked_mul(self.item.size())?;
        list.checked_add(self.before + self.length.size() + self.after)
    }

    /// Cuts the faces into fans, which are as many triangles as there are places.
    fn fans(&self, mut bytes: &[u8], vertices: u32, to: &mut [[u32; 3]]) -> Option<()> {
        let item = self.item.size();
        let mut places = to.iter_mut();
        while !bytes.is_empty() {
            let corners = self.corners(bytes)?;
            let (record, rest) = bytes.split_at_checked(self.size(corners)?)?;
            bytes = rest;
            let list = record.get(self.before + self.length.size()..record.len() - self.after)?;
            let mut indices = list
                .chunks_exact(item)
                .map(|bytes| self.natural(self.item, bytes).filter(|&vertex| vertex < vertices));
            let mut fan = [0; 2];
            for corner in &mut fan {
                match indices.next() {
                    Some(index) => *corner = index?,
                    None => break,
                }
            }
            for index in indices {
                let vertex = index?;
                *places.next()? = [fan[0], fan[1], vertex];
                fan[1] = vertex;
            }
        }
        Some(())
    }

    /// The natural number that some bytes begin with; `None` for any other number.
    #[inline(always)]
    fn natural(&self, kind: Scalar, bytes: &[u8]) -> Option<u32> {
        match (kind, self.order) {
            (Scalar::U8, _) => bytes.first().map(|&byte| byte.into()),
            (Scalar::U32, Order::Little) => bytes.first_chunk().map(|&b| u32::from_le_bytes(b)),
            (Scalar::U32, Order::Big) => bytes.first_chunk().map(|&b| u32::from_be_bytes(b)),
            (Scalar::I32, Order::Little) => {
                u32::try_from(i32::from_le_bytes(*bytes.first_chunk()?)).ok()
            }
            (Scalar::I32, Order::Big) => {
                u32::try_from(i32::from_be_bytes(*bytes.first_chunk()?)).ok()
            }
            _ => {
                let number = self.order.number(kind, bytes)?;
                Some(number as u32).filter(|&natural| f64::from(natural) == number)
            }
        }
    }
}
