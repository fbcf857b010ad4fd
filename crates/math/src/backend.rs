//! The one table of float functions and its two backends.
//!
//! `sqrt` is correctly rounded by IEEE 754, so both backends use the hardware's where `std` is there.

macro_rules! table {
    ($name:ident, $float:ident, $backend:ident; $($function:ident),*; $($function2:ident),*) => {
        pub(crate) mod $name {
            $(#[inline(always)]
            pub(crate) fn $function(x: $float) -> $float { table!(@$backend $float $function x) })*
            $(#[inline(always)]
            pub(crate) fn $function2(x: $float, y: $float) -> $float { table!(@$backend $float $function2 x, y) })*
        }
    };
    (@std $float:ident $function:ident $($x:ident),*) => { $float::$function($($x),*) };
    (@libm f32 $function:ident $($x:ident),*) => { super::libm_f32::$function($($x),*) };
    (@libm f64 $function:ident $($x:ident),*) => { super::libm_f64::$function($($x),*) };
}

#[cfg(feature = "libm")]
mod chosen {
    table!(f32, f32, libm; sin, cos, tan, asin, acos, atan, exp, exp_m1, ln, ln_1p; atan2, powf);
    table!(f64, f64, libm; sin, cos, tan, asin, acos, atan, exp, exp_m1, ln, ln_1p; atan2, powf);
    use libm_crate as libm;
    mod libm_f32 {
        pub(super) use super::libm::{
            acosf as acos, asinf as asin, atan2f as atan2, atanf as atan, cosf as cos, expf as exp,
            expm1f as exp_m1, log1pf as ln_1p, logf as ln, powf, sinf as sin, tanf as tan,
        };
    }
    mod libm_f64 {
        pub(super) use super::libm::{
            acos, asin, atan, atan2, cos, exp, expm1 as exp_m1, log as ln, log1p as ln_1p,
            pow as powf, sin, tan,
        };
    }
}

#[cfg(all(feature = "std", not(feature = "libm")))]
#[allow(
    clippy::disallowed_methods,
    reason = "the one place that may name the platform's functions"
)]
mod chosen {
    table!(f32, f32, std; sin, cos, tan, asin, acos, atan, exp, exp_m1, ln, ln_1p; atan2, powf);
    table!(f64, f64, std; sin, cos, tan, asin, acos, atan, exp, exp_m1, ln, ln_1p; atan2, powf);
}

/// Functions whose result IEEE 754 fixes, taken from the fastest source there is.
macro_rules! exact {
    ($name:ident, $float:ident, $sqrt:ident, $floor:ident, $fma:ident) => {
        pub(crate) mod $name {
            #[cfg(feature = "std")]
            #[inline(always)]
            pub(crate) fn sqrt(x: $float) -> $float {
                $float::sqrt(x)
            }
            #[cfg(not(feature = "std"))]
            #[inline(always)]
            pub(crate) fn sqrt(x: $float) -> $float {
                libm_crate::$sqrt(x)
            }
            #[cfg(feature = "std")]
            #[inline(always)]
            pub(crate) fn floor(x: $float) -> $float {
                $float::floor(x)
            }
            #[cfg(not(feature = "std"))]
            #[inline(always)]
            pub(crate) fn floor(x: $float) -> $float {
                libm_crate::$floor(x)
            }
            #[cfg(feature = "std")]
            #[inline(always)]
            pub(crate) fn mul_add(x: $float, y: $float, z: $float) -> $float {
                $float::mul_add(x, y, z)
            }
            #[cfg(not(feature = "std"))]
            #[inline(always)]
            pub(crate) fn mul_add(x: $float, y: $float, z: $float) -> $float {
                libm_crate::$fma(x, y, z)
            }
        }
    };
}
pub(crate) mod exact {
    exact!(f32, f32, sqrtf, floorf, fmaf);
    exact!(f64, f64, sqrt, floor, fma);
}

#[cfg(any(feature = "std", feature = "libm"))]
pub(crate) use chosen::{f32, f64};
