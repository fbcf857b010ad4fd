//! The few functions of Embree 4 that the comparison calls.

use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::path::Path;
use std::sync::atomic::{AtomicIsize, Ordering};

use etendue_scene::geometry::Ray;
use libloading::Library;

use crate::mesh::Mesh;

type Handle = *mut c_void;

/// `RTCRay` and `RTCHit` of `rtcore_ray.h`, one level of instances.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct RtcRay {
    origin: [f32; 3],
    tnear: f32,
    direction: [f32; 3],
    time: f32,
    tfar: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct RtcHit {
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: c_uint,
    geometry: c_uint,
    /// `instID` and, where the library is compiled with arrays of instances, `instPrimID`; padding otherwise.
    instance: [c_uint; 2],
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    hit: RtcHit,
}

const _: () = assert!(size_of::<RtcRay>() == 48 && size_of::<RtcRayHit>() == 96);

const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
const BUFFER_TYPE_INDEX: c_int = 0;
const BUFFER_TYPE_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const BUILD_QUALITY_HIGH: c_int = 2;
const SCENE_FLAG_ROBUST: c_int = 1 << 2;
const INVALID: c_uint = c_uint::MAX;

/// Bytes that the library holds, as it reports them.
static BYTES: AtomicIsize = AtomicIsize::new(0);

extern "C" fn memory_changed(_: *mut c_void, bytes: isize, _post: bool) -> bool {
    BYTES.fetch_add(bytes, Ordering::Relaxed);
    true
}

type Trace<T> = unsafe extern "C" fn(Handle, *mut T, *mut c_void);

/// The library with a device.
pub struct Embree {
    library: Library,
    device: Handle,
    intersect: Trace<RtcRayHit>,
    occluded: Trace<RtcRay>,
}

impl Embree {
    /// Loads the library and asks it for so many threads.
    pub fn load(path: &Path, threads: usize) -> Result<Self, libloading::Error> {
        // SAFETY: the signatures are those of `rtcore.h` of Embree 4, and the device lives as long as the library.
        unsafe {
            let library = Library::new(path)?;
            let config = CString::new(format!("threads={threads}")).expect("no NUL");
            let new: unsafe extern "C" fn(*const c_char) -> Handle =
                *library.get(b"rtcNewDevice\0")?;
            let monitor: unsafe extern "C" fn(
                Handle,
                extern "C" fn(*mut c_void, isize, bool) -> bool,
                Handle,
            ) = *library.get(b"rtcSetDeviceMemoryMonitorFunction\0")?;
            let device = new(config.as_ptr());
            assert!(!device.is_null(), "Embree gives no device");
            monitor(device, memory_changed, std::ptr::null_mut());
            let (intersect, occluded) =
                (*library.get(b"rtcIntersect1\0")?, *library.get(b"rtcOccluded1\0")?);
            Ok(Self { library, device, intersect, occluded })
        }
    }

    fn function<T: Copy>(&self, name: &str) -> T {
        // SAFETY: whoever calls names the function's type.
        let symbol = unsafe { self.library.get::<T>(name.as_bytes()) };
        *symbol.unwrap_or_else(|error| panic!("{error}"))
    }

    /// A scene of quality `high` with a mesh in it, not built yet.
    pub fn prepare(&self, mesh: &Mesh, robust: bool) -> Scene<'_> {
        type Of<A> = unsafe extern "C" fn(Handle, A);
        type Buffer =
            unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
        let new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle =
            self.function("rtcNewGeometry");
        let new_scene: unsafe extern "C" fn(Handle) -> Handle = self.function("rtcNewScene");
        let buffer: Buffer = self.function("rtcSetNewGeometryBuffer");
        let attach: unsafe extern "C" fn(Handle, Handle) -> c_uint =
            self.function("rtcAttachGeometry");
        let commit_geometry: unsafe extern "C" fn(Handle) = self.function("rtcCommitGeometry");
        let release_geometry: unsafe extern "C" fn(Handle) = self.function("rtcReleaseGeometry");
        let quality: Of<c_int> = self.function("rtcSetSceneBuildQuality");
        let flags: Of<c_int> = self.function("rtcSetSceneFlags");
        // SAFETY: the buffers are as long as the counts say; handles are used before they are released.
        unsafe {
            let scene = new_scene(self.device);
            quality(scene, BUILD_QUALITY_HIGH);
            flags(scene, if robust { SCENE_FLAG_ROBUST } else { 0 });
            let geometry = new_geometry(self.device, GEOMETRY_TYPE_TRIANGLE);
            let vertices = mesh.positions.len();
            let to = buffer(geometry, BUFFER_TYPE_VERTEX, 0, FORMAT_FLOAT3, 12, vertices);
            std::ptr::copy_nonoverlapping(
                mesh.positions.as_ptr().cast(),
                to.cast::<[f32; 3]>(),
                vertices,
            );
            let to = buffer(geometry, BUFFER_TYPE_INDEX, 0, FORMAT_UINT3, 12, mesh.triangles.len());
            std::ptr::copy_nonoverlapping(mesh.triangles.as_ptr(), to.cast(), mesh.triangles.len());
            commit_geometry(geometry);
            attach(scene, geometry);
            release_geometry(geometry);
            Scene { embree: self, scene, bytes: 0 }
        }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        let release: unsafe extern "C" fn(Handle) = self.function("rtcReleaseDevice");
        // SAFETY: the device is the library's, and nothing of it is left: scenes borrow `self`.
        unsafe { release(self.device) };
    }
}

/// A scene, which has to be built before it is asked.
pub struct Scene<'a> {
    embree: &'a Embree,
    scene: Handle,
    bytes: usize,
}

impl Scene<'_> {
    /// Builds it.
    pub fn commit(mut self) -> Self {
        let commit: unsafe extern "C" fn(Handle) = self.embree.function("rtcCommitScene");
        let before = BYTES.load(Ordering::Relaxed);
        // SAFETY: the scene is the library's, and whole.
        unsafe { commit(self.scene) };
        self.bytes = (BYTES.load(Ordering::Relaxed) - before) as usize;
        self
    }

    /// Memory of the hierarchy, without the vertices and indices that the fast mode could do without.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Where the closest hit is.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<f32> {
        let hit = RtcHit {
            normal: [0.0; 3],
            uv: [0.0; 2],
            primitive: INVALID,
            geometry: INVALID,
            instance: [INVALID; 2],
        };
        let mut rayhit = RtcRayHit { ray: rtc(ray), hit };
        // SAFETY: the scene is committed; no arguments means the default ones.
        unsafe { (self.embree.intersect)(self.scene, &raw mut rayhit, std::ptr::null_mut()) };
        (rayhit.hit.geometry != INVALID).then_some(rayhit.ray.tfar)
    }

    /// Whether anything is hit.
    #[inline(always)]
    pub fn occluded(&self, ray: &Ray) -> bool {
        let mut ray = rtc(ray);
        // SAFETY: as above.
        unsafe { (self.embree.occluded)(self.scene, &raw mut ray, std::ptr::null_mut()) };
        ray.tfar == f32::NEG_INFINITY
    }
}

impl Drop for Scene<'_> {
    fn drop(&mut self) {
        let release: unsafe extern "C" fn(Handle) = self.embree.function("rtcReleaseScene");
        // SAFETY: nothing refers to the scene any more.
        unsafe { release(self.scene) };
    }
}

#[inline(always)]
fn rtc(ray: &Ray) -> RtcRay {
    RtcRay {
        origin: ray.origin.to_array(),
        tnear: 0.0,
        direction: ray.direction.to_array(),
        time: 0.0,
        tfar: ray.t_max,
        mask: u32::MAX,
        id: 0,
        flags: 0,
    }
}
