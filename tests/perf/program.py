"""The command `etendue`, run and measured: processor time, clock, memory and what it says of itself."""
import dataclasses
import json
import os
import statistics
import subprocess
import threading
import time


@dataclasses.dataclass
class Run:
    seconds: float  # of processors, by the program and the system for it
    clock: float
    peak_bytes: int  # as the program itself knows it: what the system says of a child includes its parent
    report: dict


def run(command, environment=None):
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    clock = time.perf_counter() - start
    if status != 0:
        raise SystemExit(f"{' '.join(command)} failed")
    report = json.loads(output)
    return Run(usage.ru_utime + usage.ru_stime, clock, report["peak_rss"], report)


def rendering_seconds(command):
    """Processor seconds of the rendering alone, for scenes whose loading takes most of the time and differs by more than a rendering.

    The program says how long it rendered by the clock, at the end; what it had used of processors then is looked up in a log.
    """
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    log, ended = [], threading.Event()

    def watch():
        while not ended.wait(0.02):
            with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            log.append((time.perf_counter(), (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")))

    watcher = threading.Thread(target=watch)
    watcher.start()
    line = process.stdout.readline()
    end = time.perf_counter()
    ended.set()
    watcher.join()
    if process.wait() != 0:
        raise SystemExit(f"{' '.join(command)} failed")
    begin = end - json.loads(line)["render_seconds"]
    return log[-1][1] - max(seconds for clock, seconds in log if clock <= begin)


def command(binary, scene, output, *arguments, threads=1):
    return [binary, "render", scene, "-o", output, "--json", "--quiet", "--threads", str(threads), *map(str, arguments)]


def render(binary, scene, output, *arguments, threads=1):
    return run(command(binary, scene, output, *arguments, threads=threads))


FIRST_PIXEL = ["--crop", "0,0,1,1", "--spp", "1"]


def start(binary, scene, output, *arguments, rounds=3):
    """What is spent before the first sample: a picture of one pixel and one sample, the median of some, or one that takes long."""
    runs = []
    while len(runs) < rounds and not (runs and runs[-1].clock > 5):
        runs.append(render(binary, scene, output, *arguments, *FIRST_PIXEL))
    middle = [statistics.median(values) for values in zip(*((r.seconds, r.clock, r.peak_bytes) for r in runs))]
    return Run(*middle, runs[0].report)
