"""Checks that documents keep their word.

  check.py commands BOXWOOD DOCUMENT   runs its blocks marked ```sh run in order, in a scratch folder that has a small bunny.obj
                                       and scene.pbrt; of blocks marked ```sh by-hand it checks that the options exist
  check.py links ROOT                  every link and every anchor of README.md and docs/ leads somewhere, every page can be
                                       reached from docs/README.md, and a block under <!-- FILE --> is that file, whole
"""
import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^(```+)(.*)$")


def blocks(text):
    """The fenced blocks: (line of the first line inside, what stands behind the fence, the lines, the line above the fence)."""
    found, lines, opened, above = [], text.split("\n"), None, ""
    for number, line in enumerate(lines, 1):
        fence = FENCE.match(line)
        if opened is None:
            if fence:
                opened = (number + 1, fence[2].strip(), [], above, fence[1])
            elif line.strip():
                above = line.strip()
        elif fence and fence[1] == opened[4] and not fence[2].strip():
            found.append(opened[:4])
            opened, above = None, ""
        else:
            opened[2].append(line)
    return found


def write_bunny(path):
    """A ball that stands for the reader's mesh."""
    rings, sides = 12, 24
    with open(path, "w") as out:
        for ring in range(rings + 1):
            for side in range(sides):
                a, b = math.pi * ring / rings, 2 * math.pi * side / sides
                out.write(f"v {math.sin(a) * math.cos(b):.6f} {math.cos(a):.6f} {math.sin(a) * math.sin(b):.6f}\n")
        for ring in range(rings):
            for side in range(sides):
                corner = ring * sides + side + 1
                right = ring * sides + (side + 1) % sides + 1
                out.write(f"f {corner} {right} {right + sides} {corner + sides}\n")


SCENE = """LookAt 0 1 4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 64 "integer yresolution" 48
WorldBegin
LightSource "point" "point3 from" [2 4 3] "rgb I" [20 20 20]
Material "diffuse" "rgb reflectance" [0.7 0.6 0.5]
Shape "sphere" "float radius" 1
Shape "trianglemesh" "point3 P" [-5 -1 -5  5 -1 -5  5 -1 5  -5 -1 5] "integer indices" [0 1 2 0 2 3]
"""


def run(block, folder, environment):
    script = "set -eu\n" + "\n".join(block) + "\n"
    done = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", timeout=280)
    return done.returncode, done.stdout


def unknown_options(block, boxwood):
    """Options of `boxwood COMMAND …` lines that the command's help does not name."""
    unknown = []
    for line in block:
        words = shlex.split(line, comments=True)
        if len(words) < 2 or words[0] != "boxwood":
            continue
        help_text = subprocess.run([boxwood, words[1], "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        known = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", help_text))
        unknown += [f"boxwood {words[1]} has no option {word}" for word in words[2:] if word.startswith("-") and word not in known]
    return unknown


def check_commands(boxwood, document):
    boxwood = os.path.abspath(boxwood)
    text = pathlib.Path(document).read_text(encoding="utf-8")
    failed = False
    with tempfile.TemporaryDirectory(prefix="boxwood-docs-") as folder:
        environment = dict(os.environ, PATH=f"{os.path.dirname(boxwood)}:{os.environ['PATH']}", XDG_CACHE_HOME=f"{folder}/.cache")
        write_bunny(f"{folder}/bunny.obj")
        pathlib.Path(folder, "scene.pbrt").write_text(SCENE)
        for line, mark, block, _ in blocks(text):
            if mark == "sh run":
                code, output = run(block, folder, environment)
                problems = [output, f"ends with exit code {code}"] if code else []
            elif mark == "sh by-hand":
                problems = unknown_options(block, boxwood)
            elif mark.split(" ")[0] in ("sh", "bash", "shell", "console"):
                problems = ["is neither marked 'sh run' nor 'sh by-hand'"]
            else:
                continue
            if problems:
                failed = True
                print(f"{document}:{line}: this block " + "\n".join(problems))
    return failed


def anchor(heading):
    """What GitHub makes of a heading."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    kept = "".join(c for c in heading.strip().lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def outside_blocks(text):
    """The text with fenced blocks and code spans left out, line by line."""
    inside, lines = None, []
    for line in text.split("\n"):
        fence = FENCE.match(line)
        if fence and inside is None:
            inside = fence[1]
        elif fence and fence[1] == inside:
            inside = None
        elif inside is None:
            lines.append(re.sub(r"`[^`]*`", "", line))
            continue
        lines.append("")
    return lines


def headings(path):
    text = pathlib.Path(path).read_text(encoding="utf-8")
    inside, found = None, set()
    for line in text.split("\n"):
        fence = FENCE.match(line)
        if fence:
            inside = fence[1] if inside is None else (None if fence[1] == inside else inside)
        elif inside is None and re.match(r"#+ ", line):
            found.add(anchor(re.sub(r"^#+ ", "", line)))
    return found


def check_links(root):
    root = pathlib.Path(root).resolve()
    pages = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    problems, leads_to = [], {page: set() for page in pages}
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for number, line in enumerate(outside_blocks(text), 1):
            for target in re.findall(r"\]\(([^)\s]+)\)", line):
                if re.match(r"[a-z]+:", target):
                    continue
                file, _, place = target.partition("#")
                path = (page.parent / file).resolve() if file else page
                where = f"{page.relative_to(root)}:{number}: "
                if not path.exists():
                    problems.append(where + f"there is no {file}")
                    continue
                if path in leads_to:
                    leads_to[page].add(path)
                if place and place not in headings(path):
                    problems.append(where + f"{path.name} has no heading #{place}")
        for line, _, block, above in blocks(text):
            named = re.fullmatch(r"<!-- ([\w./-]+) -->", above)
            if not named:
                continue
            copied = root / named[1]
            if not copied.exists() or copied.read_text(encoding="utf-8").rstrip("\n") != "\n".join(block).rstrip("\n"):
                problems.append(f"{page.relative_to(root)}:{line}: this block is not what {named[1]} says")
    reached, queue = set(), [root / "docs" / "README.md"]
    while queue:
        page = queue.pop()
        if page not in reached:
            reached.add(page)
            queue += leads_to.get(page, ())
    problems += [f"{page.relative_to(root)} cannot be reached from docs/README.md" for page in pages if page not in reached]
    print("\n".join(problems))
    return bool(problems)


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "commands":
        sys.exit(check_commands(sys.argv[2], sys.argv[3]))
    if len(sys.argv) == 3 and sys.argv[1] == "links":
        sys.exit(check_links(sys.argv[2]))
    sys.exit(__doc__)
