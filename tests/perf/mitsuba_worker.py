"""Mitsuba 3 as a contestant: a process that has loaded a scene and renders it when asked.

As a program, `mitsuba_worker.py SCENE SIZE SPP SAMPLER`: prints the seconds until a first pixel, warms up, then renders with the
seed of every line it reads, writes the picture to the file the line names, and prints seconds of processors and peak bytes.
"""
import json
import os
import subprocess
import sys
import time


class Mitsuba:
    """A scene and a sampler in a process of its own, on one thread like the others."""

    def __init__(self, scene, folder, options, sampler):
        start = time.perf_counter()
        self.output = os.path.join(folder, "mitsuba.pfm")
        command = [sys.executable, os.path.abspath(__file__), scene, str(options.size), str(options.spp), sampler]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        if not self.process.stdout.readline():
            raise SystemExit("Mitsuba did not start: is the package installed, and DRJIT_LIBLLVM_PATH set?")
        self.first_pixel = time.perf_counter() - start
        self.peak_bytes = 0

    def render(self, seed):
        import pictures

        self.process.stdin.write(json.dumps([seed, self.output]) + "\n")
        self.process.stdin.flush()
        seconds, self.peak_bytes = json.loads(self.process.stdout.readline())
        return seconds, pictures.read_pfm(self.output)

    def close(self):
        self.process.communicate()


def peak_bytes():
    """Most resident bytes so far; `getrusage` would tell of the parent if that was larger."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("VmHWM"))


def main():
    import drjit
    import mitsuba

    scene, size, spp, sampler = sys.argv[1:]
    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(1)
    with open(scene, encoding="utf-8") as file:
        text = file.read().replace('type="independent"', f'type="{sampler}"')
    path = os.path.join(os.path.dirname(scene), f"{sampler}.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)

    def render(loaded, spp, seed):
        image = mitsuba.render(loaded, spp=spp, seed=seed)
        drjit.eval(image)
        drjit.sync_thread()
        return image

    loaded = mitsuba.load_file(path, size=int(size), spp=int(spp))
    parameters = mitsuba.traverse(loaded)
    crop = next(key for key in parameters.keys() if key.endswith("film.crop_size"))
    for side in [1, int(size)]:
        parameters[crop] = [side, side]
        parameters.update()
        if side == 1:
            render(loaded, 1, 0)
            print("first pixel", flush=True)
    render(loaded, int(spp), 0)  # compiles the kernels of the size that is measured
    for line in sys.stdin:
        seed, output = json.loads(line)
        start = time.process_time()
        image = render(loaded, int(spp), seed)
        seconds = time.process_time() - start
        mitsuba.Bitmap(image).convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False).write(output)
        print(json.dumps([seconds, peak_bytes()]), flush=True)


if __name__ == "__main__":
    main()
