#!/usr/bin/env python3
"""Whether check_pages.py finds what is wrong: damages a copy of the pages in one place after the other.

    check_checks.py --source DIR --build DIR
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# check, page, text, what stands in its place, what the check must say
DAMAGES = [
    ("readme", "README.md", "# Pelagos\n", "# Pelagos\n" + "more\n" * 150, "allowed: 150"),
    ("links", "README.md", "](docs/wire.md)", "](docs/wires.md)", "there is no docs/wires.md"),
    ("links", "README.md", "#command-logs-and-replays", "#command-log", "has no heading #command-log"),
    ("paths", "docs/how_to_add/solver.md", "`server/physics/src/fluid.cpp`", "`server/physics/src/fluids.cpp`",
     "there is no `server/physics/src/fluids.cpp`"),
    ("names", "docs/how_to_add/command.md", "`kCommandFields`", "`kCommandField`", "there is no `kCommandField`"),
    ("index", "docs/README.md", "(limits.md)", "(wire.md)", "does not link limits.md"),
    ("options", "docs/operators.md", "| `--unpaced` | off |", "| `--fast` | off |", "`--unpaced` is in the code"),
    ("options", "docs/operators.md", "| `--control HOST:PORT` | 127.0.0.1:7410 |",
     "| `--control HOST:PORT` | 127.0.0.1:7411 |", "--control has the default 127.0.0.1:7410"),
    ("options", "docs/viewer.md", "| `--wait` | 30 |", "| `--wait` | 31 |", "--wait has the default 30"),
    ("ctl", "docs/control.md", "| `status` |", "| `state` |", "`status` is in the code"),
    ("topics", "docs/wire.md", "| `wind_v1` |", "| `wind_v2` |", "`wind_v1` is in the code"),
    ("topics", "docs/wire.md", "| `probe_v1` | server | source, probe |", "| `probe_v1` | server | source |",
     "`probe_v1` has the key source;"),
    ("topics", "docs/wire.md", "reliable, KEEP_LAST 64, volatile", "reliable, KEEP_LAST 32, volatile", "KEEP_LAST 64"),
    ("topics", "docs/wire.md", "| `wind_v1` | server | source | reliable, KEEP_LAST 1, transient local |",
     "| `wind_v1` | server | source | reliable, KEEP_LAST 1, volatile |", "in the code transient local"),
    ("scene_entries", "docs/scenes.md", "| `seed` | 1 |", "| `seeds` | 1 |", "`seed` is in the code"),
    ("scene_entries", "docs/scenes.md", "| `gravity` | 9.81 |", "| `gravity` | 9.8 |", "proto/scene.proto has 9.81"),
    ("scene_entries", "docs/scenes.md", "| `patch` | required |", "| `patch` | none |", "`patch` has the default none"),
    ("error_codes", "docs/control.md", "| `RATE_LIMITED` |", "| `TOO_FAST` |", "`RATE_LIMITED` is in the code"),
    ("oils", "docs/scenes.md", "| `diesel` | 852.98 |", "| `diesel` | 845 |", "\"diesel\" has (845.0"),
    ("oils", "docs/scenes.md", "| 12.3 | refined |", "| 12.3 | crude |", "\"heavy fuel oil\" has"),
    ("stages", "docs/physics.md", "| `filter` |", "| `smooth` |", "`filter` is in the code"),
    ("passes", "docs/viewer.md", "| opaque |", "| bodies |", "`opaque` is in the code"),
    ("folders", "docs/architecture.md", "| `server/oil` |", "| `server/slick` |", "`server/oil` is in the code"),
    ("state", "docs/architecture.md", "| `foam` |", "| `spray` |", "`foam` is in the code"),
]
COPIED = ["docs", "README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md"]
NOT_LINKED = {"build", "out", ".git", ".cache", *COPIED}


def copy_of(source):
    folder = Path(tempfile.mkdtemp(prefix="pelagos-pages-"))
    for entry in source.iterdir():
        if entry.name not in NOT_LINKED:
            (folder / entry.name).symlink_to(entry)
    for name in COPIED:
        if (source / name).is_dir():
            shutil.copytree(source / name, folder / name, ignore=shutil.ignore_patterns("*.png", "*.csv"))
        else:
            shutil.copy(source / name, folder / name)
    return folder


def try_damage(folder, build, damage):
    """None, or what is wrong with the check."""
    check, page, text, other, said = damage
    file = folder / page
    whole = file.read_text()
    if text not in whole:
        return f"{page} has no {text!r}: choose another place to damage"
    file.write_text(whole.replace(text, other, 1))
    try:
        run = subprocess.run([sys.executable, Path(__file__).parent / "check_pages.py", check, "--source", folder,
                              "--build", build], capture_output=True, text=True)
    finally:
        file.write_text(whole)
    if run.returncode != 1 or said not in run.stderr:
        return f"{check}: {text!r} became {other!r} in {page}, and the check said:\n{run.stderr}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    arguments = parser.parse_args()
    folder = copy_of(arguments.source.resolve())
    try:
        faults = [fault for damage in DAMAGES if (fault := try_damage(folder, arguments.build.resolve(), damage))]
    finally:
        shutil.rmtree(folder)
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
