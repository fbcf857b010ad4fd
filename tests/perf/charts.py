"""Charts as SVG files for light and dark pages, drawn by the example `chart` of etendue-report as all of the project's are."""
import json
import os
import subprocess

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def axis(label, log=True):
    return {"label": label, "log": log}


def power(exponent, through, label):
    """The line y ∝ x^exponent through a point."""
    return {"exponent": exponent, "through": through, "label": label}


def write(path, title, x, y, series, powers=(), levels=()):
    """`series` maps names to points [x, y]."""
    chart = {
        "title": title, "x": x, "y": y, "powers": list(powers), "levels": list(levels),
        "series": [{"name": name, "points": points} for name, points in series.items()],
    }
    command = ["cargo", "run", "--quiet", "--locked", "-p", "etendue-report", "--example", "chart"]
    drawn = subprocess.run(command, cwd=ROOT, input=json.dumps(chart).encode(), stdout=subprocess.PIPE, check=True).stdout
    with open(path, "wb") as file:
        file.write(drawn)
