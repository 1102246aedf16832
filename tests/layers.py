#!/usr/bin/env python3
"""Who may include what, and how long files and functions may be. Fails with a line for each breach.

Floors: core 1, io and render 2, app 3, ui 4. A file includes only its own folder's floor or a lower one; io and render
never include each other. Inside core the folders have an order, too. Heavy libraries stay in the files that may name them.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALLOWED = {
    "core": {"core"},
    "io": {"io", "core"},
    "render": {"render", "core"},
    "app": {"app", "io", "render", "core"},
    "ui": {"ui", "app", "io", "render", "core"},
}
CORE_ORDER = {"foundation": 0, "geometry": 1, "design": 2, "georeference": 3, "registration": 4, "cleaning": 4,
              "surface": 4, "profiling": 5, "job": 6, "simulation": 7}
# A library's headers may be named only in files that match.
HEAVY = {
    r"^pcl/": r"_pcl\.(cpp|h)$|^io/pcd",
    r"^E57": r"^io/\w+_e57format\.(cpp|h)$",
    r"^laszip/": r"^io/\w+_laszip\.(cpp|h)$",
    r"^CGAL/": r"_cgal\.(cpp|h)$",
    r"^ceres/": r"_ceres\.cpp$",
    r"^polyclipping/": r"_clipper\.cpp$",
    r"^opencv2/": r"_opencv\.cpp$",
    r"^jpeglib\.h$": r"_libjpeg\.cpp$",
    r"^OpenMesh/": r"^core/surface/",
    r"^vtk": r"^render/",
    r"^(GL/)?osmesa": r"^render/gl_context_osmesa\.cpp$",
    r"^(cairo|pango)": r"^render/",
    r"^GLFW/": r"^ui/",
    r"^imgui": r"^ui/|^tests/ui/",
    r"^spdlog/": r"^(app|ui)/",
}
LONGEST_FILE = 500
problems = []
lengths = []


def check_include(path, line_number, target):
    layer, parts = path.parts[0], target.split("/")
    place = f"{path}:{line_number}"
    if layer in ALLOWED and parts[0] in ALLOWED and parts[0] not in ALLOWED[layer]:
        problems.append(f"{place}: {layer} may not include {target}")
    if layer == "core" and parts[0] == "core" and len(parts) > 2:
        mine, other = path.parts[1], parts[1]
        same_floor = mine != other and CORE_ORDER[mine] == CORE_ORDER[other]
        if CORE_ORDER[other] > CORE_ORDER[mine] or same_floor:
            problems.append(f"{place}: core/{mine} may not include core/{other}")
    for pattern, where in HEAVY.items():
        if re.search(pattern, target) and layer != "tests" and not re.search(where, str(path)):
            problems.append(f"{place}: {target} does not belong here")


for file in sorted(ROOT.glob("*/**/*")):
    path = file.relative_to(ROOT)
    if file.suffix not in (".h", ".cpp") or path.parts[0] not in (*ALLOWED, "tests"):
        continue
    lines = file.read_text(encoding="utf-8").splitlines()
    lengths.append(len(lines))
    if len(lines) > LONGEST_FILE:
        problems.append(f"{path}: {len(lines)} lines; one idea per file, {LONGEST_FILE} at most")
    for number, line in enumerate(lines, 1):
        found = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if found:
            check_include(path, number, found.group(1))

for page in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]:
    for link in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        if "://" not in link and not (page.parent / link).exists():
            problems.append(f"{page.relative_to(ROOT)}: dead link {link}")

lengths.sort()
if lengths:
    print(f"{len(lengths)} files, median {lengths[len(lengths) // 2]}, p90 {lengths[len(lengths) * 9 // 10]}, longest {lengths[-1]} lines")
print("\n".join(problems))
sys.exit(1 if problems else 0)
