#!/usr/bin/env python3
"""Values and densities of Mitsuba 3's `principled` and `principledthin`, as rows for a test of etendue-brdf.

usage: principled_rows.py [--pairs 12] [--output crates/brdf/tests/principled/rows.jsonl]

One row per parameter set and direction pair: plugin, parameters, wo (viewer), wi (light), f (RGB, without the
cosine) and pdf. Directions and parameters are exact in `f32`. Directions within 0.05 of the horizon are left out:
there Mitsuba's `f32` arithmetic itself is off by more than the test allows. Needs `pip install mitsuba`.
"""
import argparse
import json
import math
import random

import numpy


PRINCIPLED = [
    {},
    {"base_color": [0.9, 0.6, 0.2], "metallic": 1.0, "roughness": 0.25},
    {"base_color": [0.9, 0.6, 0.2], "metallic": 0.5, "roughness": 0.5, "spec_tint": 0.5},
    {"base_color": [0.2, 0.4, 0.8], "roughness": 0.75, "flatness": 0.5},
    {"base_color": [0.2, 0.4, 0.8], "roughness": 1.0, "flatness": 1.0, "eta": 1.25},
    {"base_color": [0.7, 0.1, 0.1], "sheen": 1.0, "sheen_tint": 0.5},
    {"base_color": [0.7, 0.1, 0.1], "sheen": 0.5},
    {"base_color": [0.5, 0.5, 0.5], "clearcoat": 1.0, "clearcoat_gloss": 0.0},
    {"base_color": [0.5, 0.5, 0.5], "clearcoat": 0.75, "clearcoat_gloss": 0.5, "specular": 0.25},
    {"base_color": [0.8, 0.9, 1.0], "spec_trans": 1.0, "roughness": 0.5, "eta": 1.5},
    {"base_color": [0.8, 0.9, 1.0], "spec_trans": 0.5, "roughness": 0.75, "eta": 1.33},
    {"base_color": [0.8, 0.9, 1.0], "spec_trans": 0.75, "roughness": 0.75, "eta": 0.75},
    {"base_color": [0.8, 0.9, 1.0], "spec_trans": 0.5, "metallic": 0.5, "roughness": 0.5, "eta": 2.0},
    {"base_color": [0.5, 0.6, 0.7], "anisotropic": 1.0, "metallic": 1.0, "roughness": 0.5},
    {"base_color": [0.5, 0.6, 0.7], "anisotropic": 0.5, "spec_trans": 0.5, "roughness": 0.75},
    {"base_color": [0.1, 0.2, 0.9], "spec_tint": 1.0, "specular": 1.0, "roughness": 0.5},
    {"base_color": [0.0, 0.0, 0.0], "spec_tint": 0.5, "sheen": 0.5, "sheen_tint": 1.0},
    {"base_color": [0.4, 0.5, 0.6], "specular": 0.0, "roughness": 0.25},
    {"base_color": [0.4, 0.5, 0.6], "eta": 0.5, "metallic": 0.5, "spec_tint": 0.5, "clearcoat": 0.5},
    {"base_color": [0.4, 0.5, 0.6], "clearcoat": 1.0, "clearcoat_gloss": 0.25, "spec_trans": 0.25,
     "diffuse_reflectance_sampling_rate": 0.5, "main_specular_sampling_rate": 2.0,
     "clearcoat_sampling_rate": 4.0},
    {"base_color": [0.9, 0.5, 0.3], "roughness": 0.625, "anisotropic": 0.75, "metallic": 0.25, "spec_trans": 0.375,
     "eta": 1.75, "spec_tint": 0.25, "sheen": 0.75, "sheen_tint": 0.25, "flatness": 0.75, "clearcoat": 0.5,
     "clearcoat_gloss": 0.125},
]
THIN = [
    {},
    {"base_color": [0.7, 0.1, 0.1], "roughness": 0.5, "spec_trans": 1.0, "eta": 1.5},
    {"base_color": [0.7, 0.1, 0.1], "roughness": 0.25, "spec_trans": 0.75, "diff_trans": 0.25, "eta": 1.33,
     "spec_tint": 0.125, "anisotropic": 0.5},
    {"base_color": [0.2, 0.6, 0.1], "diff_trans": 1.0, "roughness": 1.0},
    {"base_color": [0.2, 0.6, 0.1], "diff_trans": 2.0},
    {"base_color": [0.2, 0.6, 0.1], "diff_trans": 0.5, "sheen": 1.0, "sheen_tint": 0.5, "flatness": 0.5},
    {"base_color": [0.2, 0.6, 0.1], "spec_trans": 0.5, "spec_tint": 1.0, "roughness": 1.0, "eta": 2.0},
    {"base_color": [0.8, 0.6, 0.4], "spec_trans": 0.5, "diff_trans": 0.5, "roughness": 0.75, "eta": 0.75,
     "spec_tint": 0.5},
    {"base_color": [0.8, 0.6, 0.4], "spec_trans": 0.25, "diff_trans": 1.5, "roughness": 0.5, "sheen": 0.5,
     "specular_reflectance_sampling_rate": 2.0, "specular_transmittance_sampling_rate": 0.5,
     "diffuse_reflectance_sampling_rate": 3.0, "diffuse_transmittance_sampling_rate": 0.25},
]


def exact(x):
    """`x` rounded to `f32`."""
    return float(numpy.float32(x))


def direction(rng):
    """A unit vector away from the horizon."""
    while True:
        w = [rng.gauss(0, 1) for _ in range(3)]
        length = sum(x * x for x in w) ** 0.5
        w = [exact(x / length) for x in w]
        if abs(w[2]) > 0.05:
            return w


def partner(rng, wo):
    """Any direction, or one around the mirror direction, where highlights are, or opposite to it."""
    kind = rng.random()
    if kind < 0.5:
        return direction(rng)
    side = 1 if kind < 0.75 else -1
    while True:
        w = [-wo[0] + 0.2 * rng.gauss(0, 1), -wo[1] + 0.2 * rng.gauss(0, 1), side * wo[2] + 0.1 * rng.gauss(0, 1)]
        length = sum(x * x for x in w) ** 0.5
        w = [exact(x / length) for x in w]
        if abs(w[2]) > 0.05:
            return w


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--pairs", type=int, default=12)
    parser.add_argument("--output", default="crates/brdf/tests/principled/rows.jsonl")
    options = parser.parse_args()

    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    rng = random.Random(7)
    context, surface = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()
    with open(options.output, "w") as file:
        for plugin, parameters in [("principled", p) for p in PRINCIPLED] + [("principledthin", p) for p in THIN]:
            parameters = {k: [exact(c) for c in v] if isinstance(v, list) else exact(v) for k, v in parameters.items()}
            colour = {k: {"type": "rgb", "value": v} if isinstance(v, list) else v for k, v in parameters.items()}
            bsdf = mitsuba.load_dict({"type": plugin, **colour})
            for _ in range(options.pairs):
                wo = direction(rng)
                wi = partner(rng, wo)
                surface.wi = wo
                value, pdf = bsdf.eval_pdf(context, surface, wi)
                if not math.isfinite(pdf):
                    continue  # Mitsuba's density from below where both indices are the same
                row = {"plugin": plugin, "parameters": parameters, "wo": wo, "wi": wi,
                       "f": [float(c) / abs(wi[2]) for c in value], "pdf": float(pdf)}
                file.write(json.dumps(row) + "\n")


if __name__ == "__main__":
    main()
