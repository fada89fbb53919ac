//! A sampler of environment maps as a plug-in of Lightproof: texels in proportion to luminance times
//! solid angle, found by binary search in sums of rows and of columns; positions uniform in the
//! picture inside a texel (density C). Put your own in its place.
//!
//! The structures are those of lightproof_plugin.h, which says what each member means.
use std::f64::consts::PI;
use std::ffi::{c_char, c_void};
use std::ptr::null;
use std::slice::{from_raw_parts, from_raw_parts_mut};

/// LIGHTPROOF_PLUGIN_ABI of the header.
const ABI: u32 = 1;
/// How close to the edge of a texel a sample may come, in texels: at a pole there is no density.
const EDGE: f64 = 1e-9;

#[repr(C)]
pub struct Map {
    size: u32,
    width: u32,
    height: u32,
    unused: u32,
    texels: *const f32,
    name: *const c_char,
    luminance: [f64; 3],
}

#[repr(C)]
pub struct Plugin {
    abi: u32,
    size: u32,
    name: *const c_char,
    columns: *const c_char,
    axes: *const c_char,
    preset: *const c_char,
    measure: *const c_char,
    density: *const c_char,
    luminance: *const c_char,
    rounding: f64,
    create: Option<unsafe extern "C" fn(*const Map, *mut c_char, usize) -> *mut c_void>,
    sample: Option<unsafe extern "C" fn(*mut c_void, usize, *const f64, *mut f64)>,
    draw: Option<unsafe extern "C" fn(*mut c_void, u64, u64, usize, *mut f64)>,
    pdf: Option<unsafe extern "C" fn(*mut c_void, usize, *const f64, *mut f64)>,
    destroy: Option<unsafe extern "C" fn(*mut c_void)>,
}

/// The texts that it points to are constants.
unsafe impl Sync for Plugin {}

/// Sums of probabilities, from 0 to 1.
struct Sums {
    total: f64,
    sums: Vec<f64>,
}

impl Sums {
    fn new(weights: &[f64]) -> Sums {
        let mut total = 0.0;
        let mut sums = vec![0.0];
        for weight in weights {
            total += weight;
            sums.push(total);
        }
        if total > 0.0 {
            for sum in &mut sums {
                *sum /= total;
            }
        }
        Sums { total, sums }
    }

    fn mass(&self, i: usize) -> f64 {
        self.sums[i + 1] - self.sums[i]
    }

    /// The i at which sums go beyond u: never one without probability.
    fn find(&self, u: f64) -> usize {
        let last = self.sums.len() - 1;
        self.sums[1..last].partition_point(|&sum| sum <= u)
    }

    /// How far u lies on its way through step i, from 0 to 1, but for the edges.
    fn fraction(&self, i: usize, u: f64) -> f64 {
        ((u - self.sums[i]) / self.mass(i)).clamp(EDGE, 1.0 - EDGE)
    }
}

struct Sampler {
    width: f64,
    height: f64,
    rows: Sums,
    columns: Vec<Sums>,
}

impl Sampler {
    /// `texels`: rows from the top of the picture, three numbers each.
    fn new(width: usize, height: usize, texels: &[f32], luminance: [f64; 3]) -> Sampler {
        let mut columns = Vec::with_capacity(height);
        for (row, line) in texels.chunks_exact(3 * width).enumerate() {
            let edge = |row: usize| (PI * row as f64 / height as f64).cos();
            let solid_angle = 2.0 * PI / width as f64 * (edge(row) - edge(row + 1));
            let weight = |rgb: &[f32]| -> f64 {
                let parts = rgb.iter().zip(luminance);
                solid_angle * parts.map(|(&part, by)| by * f64::from(part)).sum::<f64>()
            };
            let weights: Vec<f64> = line.chunks_exact(3).map(weight).collect();
            columns.push(Sums::new(&weights));
        }
        let row_weights: Vec<f64> = columns.iter().map(|row| row.total).collect();
        let rows = Sums::new(&row_weights);
        Sampler { width: width as f64, height: height as f64, rows, columns }
    }

    /// Per steradian, at a point of this sine of theta.
    fn density(&self, column: usize, row: usize, sine: f64) -> f64 {
        if sine <= 0.0 {
            return 0.0;
        }
        let mass = self.rows.mass(row) * self.columns[row].mass(column);
        mass * self.width * self.height / (2.0 * PI * PI * sine)
    }

    fn sample(&self, u: &[f64], numbers: &mut [f64]) {
        let row = self.rows.find(u[1]);
        let columns = &self.columns[row];
        let column = columns.find(u[0]);
        let theta = PI * (row as f64 + self.rows.fraction(row, u[1])) / self.height;
        let across = (column as f64 + columns.fraction(column, u[0])) / self.width;
        let phi = PI - 2.0 * PI * across;
        let sine = theta.sin();
        numbers[0] = sine * phi.cos();
        numbers[1] = sine * phi.sin();
        numbers[2] = theta.cos();
        numbers[3] = self.density(column, row, sine);
    }

    fn pdf(&self, at: &[f64]) -> f64 {
        let cell = |coordinate: f64, count: f64| (coordinate * count).clamp(0.0, count - 1.0) as usize;
        let sine = at[0].hypot(at[1]);
        let column = cell(0.5 - at[1].atan2(at[0]) / (2.0 * PI), self.width);
        let row = cell(sine.atan2(at[2]) / PI, self.height);
        self.density(column, row, sine)
    }
}

unsafe extern "C" fn create(map: *const Map, error: *mut c_char, bytes: usize) -> *mut c_void {
    let map = &*map;
    let (width, height) = (map.width as usize, map.height as usize);
    let texels = from_raw_parts(map.texels, 3 * width * height);
    let sampler = Sampler::new(width, height, texels, map.luminance);
    if sampler.rows.total > 0.0 {
        return Box::into_raw(Box::new(sampler)).cast();
    }
    let reason = b"the map is black\0";
    if bytes >= reason.len() {
        std::ptr::copy_nonoverlapping(reason.as_ptr().cast(), error, reason.len());
    }
    std::ptr::null_mut()
}

unsafe extern "C" fn sample(sampler: *mut c_void, count: usize, u: *const f64, rows: *mut f64) {
    let sampler = &*sampler.cast::<Sampler>();
    let points = from_raw_parts(u, 2 * count).chunks_exact(2);
    let rows = from_raw_parts_mut(rows, 4 * count).chunks_exact_mut(4);
    points.zip(rows).for_each(|(u, numbers)| sampler.sample(u, numbers));
}

unsafe extern "C" fn pdf(sampler: *mut c_void, count: usize, positions: *const f64, out: *mut f64) {
    let sampler = &*sampler.cast::<Sampler>();
    let positions = from_raw_parts(positions, 3 * count).chunks_exact(3);
    let out = from_raw_parts_mut(out, count).iter_mut();
    positions.zip(out).for_each(|(at, density)| *density = sampler.pdf(at));
}

unsafe extern "C" fn destroy(sampler: *mut c_void) {
    drop(Box::from_raw(sampler.cast::<Sampler>()));
}

static PLUGIN: Plugin = Plugin {
    abi: ABI,
    size: std::mem::size_of::<Plugin>() as u32,
    name: b"@NAME@\0".as_ptr().cast(),
    columns: null(), // x,y,z,pdf
    axes: null(),    // z up, right-handed
    preset: b"z-up\0".as_ptr().cast(),
    measure: b"solid-angle\0".as_ptr().cast(),
    density: b"C\0".as_ptr().cast(),
    luminance: null(), // by the weights of the map
    rounding: 0.0,     // up to that of floats
    create: Some(create),
    sample: Some(sample),
    draw: None, // sample is there
    pdf: Some(pdf),
    destroy: Some(destroy),
};

#[no_mangle]
pub extern "C" fn lightproof_plugin_describe() -> *const Plugin {
    &PLUGIN
}
