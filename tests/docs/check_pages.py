#!/usr/bin/env python3
"""Compares the pages of the project with its code.

    check_pages.py CHECK --source DIR --build DIR

A table that a check reads stands after a comment in the page, for instance <!-- table: stages -->. Each check names
every difference, and ends with status 1 if there is one.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

MOST_README_LINES = 150
TABLE = r"<!-- table: %s -->\n((?:\|.*\n)+)"
TOP_PAGES = ["README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md"]


class Project:
    def __init__(self, source, build):
        self.source, self.build = source, build

    def text(self, path):
        return (self.source / path).read_text()

    def pages(self):
        return TOP_PAGES + sorted(str(page.relative_to(self.source)) for page in self.source.glob("docs/**/*.md"))

    def table(self, page, name):
        """The rows of a table below its head: lists of cells."""
        found = re.search(TABLE % re.escape(name), self.text(page))
        if not found:
            raise LookupError(f"{page} has no table after <!-- table: {name} -->")
        rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in found[1].splitlines()]
        return rows[2:]

    def help(self, program, *words):
        done = subprocess.run([self.build / "bin" / program, *words, "--help"], capture_output=True, text=True,
                              timeout=60, stdin=subprocess.DEVNULL, check=True)
        return done.stdout


def quoted(cell):
    """What stands between backquotes."""
    return re.findall(r"`([^`]+)`", cell)


def compare(what, documented, real, ordered=False):
    faults = [f"{what}: `{name}` is in the code, but not in the table" for name in real if name not in documented]
    faults += [f"{what}: `{name}` is in the table, but not in the code" for name in documented if name not in real]
    faults += [f"{what}: `{name}` stands twice in the table" for name in set(documented) if documented.count(name) > 1]
    if ordered and not faults and documented != real:
        faults.append(f"{what}: the order is {', '.join(documented)}; in the code {', '.join(real)}")
    return faults


# ---- pages


def check_readme(project):
    lines = len(project.text("README.md").splitlines())
    return [] if lines <= MOST_README_LINES else [f"README.md has {lines} lines; allowed: {MOST_README_LINES}"]


def anchors(text):
    """Those that a page's headings make."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-"))
    return found


def check_links(project):
    """Files and headings that pages link to."""
    faults = []
    for page in project.pages():
        text = re.sub(r"^```.*?^```", "", project.text(page), flags=re.M | re.S)
        for link in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", link):
                continue
            name, _, anchor = link.partition("#")
            target = (project.source / page).parent / name if name else project.source / page
            if not target.exists():
                faults.append(f"{page}: there is no {link}")
            elif anchor and anchor not in anchors(target.read_text()):
                faults.append(f"{page}: {name or page} has no heading #{anchor}")
    return faults


def check_paths(project):
    """Files of the project that pages name between backquotes."""
    folders = "server|common|client-viewer|tests|proto|idl|deploy|docs|examples|assets|scenes|cmake|\\.ci"
    faults = []
    for page in project.pages():
        if page == "CHANGELOG.md" or page.startswith("docs/validation/"):
            continue  # they tell what was there
        text = re.sub(r"^```.*?^```", "", project.text(page), flags=re.M | re.S)
        for path in re.findall(rf"`((?:{folders})/[\w./-]*)`", text):
            if not (project.source / path).exists() and "NAME" not in path:
                faults.append(f"{page}: there is no `{path}`")
    return faults


def check_names(project):
    """Types, functions and constants that the guides and the architecture name between backquotes."""
    folders = ("server", "common", "client-viewer", "examples", "tests", "proto", "idl", "cmake")
    endings = {".cpp", ".hpp", ".proto", ".idl", ".glsl", ".cmake", ".txt"}
    words = set()
    for folder in folders:
        for file in (project.source / folder).rglob("*"):
            if file.suffix in endings:
                words.update(re.findall(r"\w+", file.read_text(errors="replace")))
    faults = []
    for page in project.pages():
        if not page.startswith(("docs/how_to_add/", "docs/architecture.md")):
            continue
        text = re.sub(r"^```.*?^```", "", project.text(page), flags=re.M | re.S)
        for name in re.findall(r"`([A-Za-z_][\w:.]*)`", text):
            if "NAME" in name or name.endswith((".md", ".cpp", ".hpp", ".py", ".vert", ".frag")):
                continue
            if not words.issuperset(word for word in re.split(r"::|\.", name) if word):
                faults.append(f"{page}: there is no `{name}` in the code")
    return faults


def check_index(project):
    """Every page can be reached from docs/README.md, itself or by the index of its folder."""
    faults = []
    for page in project.pages():
        if not page.startswith("docs/") or page == "docs/README.md":
            continue
        index = "docs/README.md"
        if page.startswith("docs/how_to_add/") and not page.endswith("README.md"):
            index = "docs/how_to_add/README.md"
        relative = str(Path(page).relative_to(Path(index).parent))
        if f"]({relative})" not in project.text(index):
            faults.append(f"{index}: does not link {relative}")
    return faults


# ---- command lines


def options_of(text):
    return [name for name in re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.M) if name not in ("--help", "--version")]


def check_options(project):
    faults = []
    for program, page in (("pelagos-server", "docs/operators.md"), ("pelagos-viewer", "docs/viewer.md")):
        text = project.help(program)
        rows = project.table(page, f"options of {program}")
        documented = [re.match(r"--[a-z-]+", name)[0] for row in rows for name in quoted(row[0])]
        faults += compare(f"{page}, options of {program}", documented, options_of(text))
        faults += [f"{page}: {fault}" for fault in wrong_defaults(rows, text)]
    return faults


def wrong_defaults(rows, text):
    """Where --help states a default as a value, or that an option is required, the table must have the same."""
    for row in rows:
        for name in (re.match(r"--[a-z-]+", option)[0] for option in quoted(row[0])):
            head = re.search(rf"^  {name}\b(.*)$", text, re.M)
            if not head:
                continue
            value = re.search(r"=([^\s:]\S*)", head[1])
            if "REQUIRED" in head[1] and row[1] not in ("required", "needed"):
                yield f"{name} is required; the table has the default {row[1]}"
            if value and float_or(value[1]) != 0.0 and value[1] not in row[1]:
                yield f"{name} has the default {value[1]}; the table has {row[1]}"


def float_or(text):
    try:
        return float(text)
    except ValueError:
        return text


def check_ctl(project):
    text = project.help("pelagos-ctl")
    listed = re.search(r"^Subcommands:\n(.*?)\n\n", text, re.M | re.S)[1]
    real = re.findall(r"^  ([a-z-]+) ", listed, re.M)
    documented = []
    for row in project.table("docs/control.md", "commands of pelagos-ctl"):
        documented += [name.split()[0] for name in quoted(row[0]) if not name.startswith("--")]
    return compare("docs/control.md, commands of pelagos-ctl", sorted(set(documented)), real)


# ---- contracts


def topics_in_code(project):
    """name -> (type, depth of the writer, transient local), out of the table in the code."""
    text = project.text("common/dds/wire/src/topics.cpp")
    topics = {}
    by_function = {}
    for function, body in re.findall(r"^TopicSpec (\w+)\(\) \{(.*?)\}\n", re.sub(r"\{\}", "<>", text), re.M | re.S):
        made = re.search(r'return \{"(\w+)", &pelagos_(\w+)_desc, ([^,]+), ', body)
        if made:
            name, kind, writer = made[1], made[2], made[3]
            depth = re.search(r"writer\.depth = (\d+)", body)
            late = "for_late" in writer or "TopicQos writer = for_late" in body
            entry = (kind, int(depth[1]) if depth else 1, late)
        else:
            base = by_function[re.search(r"TopicSpec spec = (\w+)\(\)", body)[1]]
            name = re.search(r'spec\.name = "(\w+)"', body)[1]
            kind = re.search(r"spec\.type = &pelagos_(\w+)_desc", body)
            entry = (kind[1] if kind else base[0], *base[1:])
        by_function[function] = entry
        topics[name] = entry
    return topics


def keys_in_contract(project):
    """type -> names of its key fields."""
    keys = {}
    for name, body in re.findall(r"@topic struct (\w+) \{(.*?)\n  \};", project.text("idl/pelagos.idl"), re.S):
        keys[name] = re.findall(r"@key\s+[\w ]+?\s(\w+);", body)
    return keys


def check_topics(project):
    real, keys = topics_in_code(project), keys_in_contract(project)
    rows = project.table("docs/wire.md", "topics")
    documented = [name for row in rows for name in quoted(row[0])]
    faults = compare("docs/wire.md, topics", documented, list(real))
    comment = re.findall(r"^//   (\w+_v\d+) ", project.text("idl/pelagos.idl"), re.M)
    faults += compare("idl/pelagos.idl, comment of topics", comment, list(real))
    if faults:
        return faults
    for topic, sender, key, service, *_ in rows:
        for name in quoted(topic):
            kind, depth, late = real[name]
            if [word.strip() for word in key.split(",")] != keys[kind]:
                faults.append(f"docs/wire.md: `{name}` has the key {key}; in the contract {', '.join(keys[kind])}")
            if sender == "server" and f"KEEP_LAST {depth}," not in service + ",":
                faults.append(f"docs/wire.md: `{name}` is written with \"{service}\"; in the code KEEP_LAST {depth}")
            if sender == "server" and late != ("transient local" in service):
                faults.append(f"docs/wire.md: `{name}` is written with \"{service}\"; in the code "
                              f"{'transient local' if late else 'volatile'}")
    return faults


def check_scene_entries(project):
    message = re.search(r"^message Scene \{\n(.*?)^\}", project.text("proto/scene.proto"), re.M | re.S)[1]
    real, comment = {}, ""
    for line in message.splitlines():
        field = re.match(r"  (?:optional|repeated) \w+ (\w+) = \d+;", line)
        if field:
            real[field[1]] = comment
        comment = comment + " " + line.strip(" /") if line.strip().startswith("//") else ""
    rows = project.table("docs/scenes.md", "scene entries")
    documented = [quoted(row[0])[0] for row in rows]
    faults = compare("docs/scenes.md, entries of a scene", documented, list(real))
    for row, name in zip(rows, documented):
        said = real.get(name, "")
        number = re.search(r"Default (\d[\d.]*\d|\d)", said)
        if ("Required." in said) != (row[1] == "required"):
            faults.append(f"docs/scenes.md: `{name}` has the default {row[1]}; proto/scene.proto:{said}")
        if number and not row[1].startswith(number[1]):
            faults.append(f"docs/scenes.md: `{name}` has the default {row[1]}; proto/scene.proto has {number[1]}")
    return faults


def check_error_codes(project):
    body = re.search(r"enum Code \{(.*?)\n  \}", project.text("proto/control.proto"), re.S)[1]
    real = {name: "(closes)" in rest for name, rest in re.findall(r"(\w+) = \d+;(.*)", body) if name != "UNSPECIFIED"}
    rows = project.table("docs/control.md", "error codes")
    documented = [quoted(row[0])[0] for row in rows]
    faults = compare("docs/control.md, error codes", documented, list(real), ordered=True)
    for row, name in zip(rows, documented):
        if real.get(name) != (row[2] != ""):
            faults.append(f"docs/control.md: whether `{name}` closes the link differs from proto/control.proto")
    return faults


def oils_in_code(project):
    """By name: density, viscosity, API gravity, refined, water in the emulsion, source."""
    text = project.text("common/values/include/values/oil.hpp")
    found = re.findall(r'\{"([\w ]+)", ([\d.]+), ([\d.]+), ([\d.]+), (true|false), ([\d.]+), "(\w+)"\}', text)
    return {name: (*map(float, numbers), {"true": "refined", "false": "crude"}[refined], float(water), source)
            for name, *numbers, refined, water, source in found}


def oils_in_contract(project):
    """By name: density, viscosity."""
    comment = re.search(r"// By name, .*?\n  optional string type", project.text("proto/scene.proto"), re.S)[0]
    return {name: (float(density), float(viscosity)) for name, density, viscosity in
            re.findall(r'"([\w ]+)"\s\(([\d.]+)(?: kg/m\^3)?, ([\d.]+)', re.sub(r"\n\s*//", "", comment))}


def check_oils(project):
    real = oils_in_code(project)
    documented = {quoted(name)[0]: (*map(float, numbers), kind, float(water), source) for
                  name, *numbers, kind, water, source in project.table("docs/scenes.md", "oils")}
    faults = compare("docs/scenes.md, oils", list(documented), list(real), ordered=True)
    contract = oils_in_contract(project)
    faults += compare("proto/scene.proto, oils", list(contract), list(real), ordered=True)
    for place, table, count in (("docs/scenes.md", documented, None), ("proto/scene.proto", contract, 2)):
        faults += [f"{place}: \"{name}\" has {table[name]}; in the code {real[name][:count]}"
                   for name in real if name in table and table[name] != real[name][:count]]
    return faults


# ---- names in the code


def names_in(project, path, pattern):
    return re.findall(r'"(\w+)"', re.search(pattern, project.text(path), re.S)[1])


def check_stages(project):
    real = names_in(project, "server/physics/include/physics/step_report.hpp", r"kStageNames = \{(.*?)\};")
    documented = [quoted(row[0])[0] for row in project.table("docs/physics.md", "stages")]
    return compare("docs/physics.md, stages", documented, real, ordered=True)


def check_passes(project):
    real = names_in(project, "client-viewer/renderer/renderer.hpp", r"kPassNames = \{(.*?)\};")
    documented = [row[0].strip("`") for row in project.table("docs/viewer.md", "passes")]
    return compare("docs/viewer.md, passes", documented, real, ordered=True)


def check_folders(project):
    """Each folder of the server and of what programs share has its place in the table of folders."""
    real = [f"{top}/{folder.name}" for top in ("server", "common") for folder in sorted((project.source / top).iterdir())
            if folder.is_dir()]
    rows = project.table("docs/architecture.md", "folders")
    documented = [name for row in rows for name in quoted(row[0]) if name.startswith(("server/", "common/"))]
    return compare("docs/architecture.md, folders", documented, real)


def check_state(project):
    text = project.text("server/simulation/include/simulation/world_state.hpp")
    real = re.findall(r'visit\("(\w+)"', text[text.index("struct WorldState"):])
    documented = [name for row in project.table("docs/architecture.md", "state") for name in quoted(row[0])]
    return compare("docs/architecture.md, state of a world", documented, real)


CHECKS = {name[len("check_"):]: function for name, function in list(globals().items()) if name.startswith("check_")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("check", choices=CHECKS)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    arguments = parser.parse_args()
    try:
        faults = CHECKS[arguments.check](Project(arguments.source.resolve(), arguments.build.resolve()))
    except LookupError as missing:
        faults = [str(missing)]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
