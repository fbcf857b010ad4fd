#!/usr/bin/env python3
"""Holds the dependencies against deny.toml: licences, sources, versions that are banned, all without cargo-deny.

usage: tests/supply_chain.py

Prints what is wrong and exits with 1, or says how many crates were checked. Advisories need `cargo deny check`.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent


def is_allowed(expression: str, allowed: set[str]) -> bool:
    """Whether a licence expression (SPDX, `/` being an old form of OR) can be met with those allowed."""
    words = re.findall(r"[()]|[^\s()]+(?: WITH [^\s()]+)?", expression.replace("/", " OR "))
    terms = [word if word in "()" else word.lower() if word in ("AND", "OR") else str(word in allowed) for word in words]
    return eval(" ".join(terms), {"__builtins__": {}})  # of True, False, and, or and parentheses


def is_below(version: str, bound: str) -> bool:
    """Whether a version lies below a bound."""
    numbers = lambda text: [int(n) for n in re.split(r"[-+]", text)[0].split(".")]
    return numbers(version) < numbers(bound)


def main() -> int:
    rules = tomllib.loads((ROOT / "deny.toml").read_text())
    allowed = set(rules["licenses"]["allow"])
    registries = rules["sources"]["allow-registry"]
    banned = dict(entry["crate"].partition("@<")[::2] for entry in rules["bans"]["deny"])
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    packages = json.loads(output)["packages"]
    wrong = []
    for package in packages:
        name, version, licence, source = (package[key] for key in ("name", "version", "license", "source"))
        title = f"{name} {version}"
        if not licence or not is_allowed(licence, allowed):
            wrong.append(f"{title}: the licence {licence} is not allowed")
        if source and not any(source == f"registry+{registry}" for registry in registries):
            wrong.append(f"{title}: comes from {source}")
        bound = banned.get(name)
        if bound is not None and (not bound or is_below(version, bound)):
            wrong.append(f"{title}: is banned{f' below {bound}' if bound else ''}")
    print("\n".join(wrong) or f"{len(packages)} crates: licences, sources and versions are as deny.toml says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
