#!/usr/bin/env python3
"""Jobs that are wrong in a way no file alone can show: wrong_jobs.py ADIT [WORD...]

Each case is a simulated job with one mistake a surveyor makes. Adit must name it, blame the right thing, and end with exit
code 1 (a person decides) or 2; and where the rest of the survey proves the mistake, the poses must still be true."""
import csv
import json
import pathlib
import re
import shutil
import struct
import sys
import tempfile

import small_job

DEMO = ["--points", "100000", "--stations", "3"]


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_rows(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def changed_rows(path, change):
    rows = rows_of(path)
    write_rows(path, [row for row in rows if change(row) is not False])


def changed_job(job, change):
    plan = json.loads((job / "job.json").read_text())
    change(plan)
    (job / "job.json").write_text(json.dumps(plan, indent=1))


def moved(row, key, by):
    row[key] = "%.6f" % (float(row[key]) + by)


def without_control(plan):
    del plan["control"], plan["targets"]


def exchanged(row, a, b):
    row[a], row[b] = row[b], row[a]


# --- the mistakes ---


def control_point_ten_centimetres_off(job):
    changed_rows(job / "control.csv", lambda row: moved(row, "east", 0.10) if row["id"] == "T105" else None)


def target_eight_centimetres_off(job):
    changed_rows(job / "targets.csv", lambda row: moved(row, "z", 0.08) if (row["scan"], row["id"]) == ("S2", "T106") else None)


def two_target_names_exchanged(job):
    names = {"T106": "T107", "T107": "T106"}
    changed_rows(job / "targets.csv", lambda row: row.update(id=names.get(row["id"], row["id"])) if row["scan"] == "S3" else None)


def targets_under_the_wrong_scan(job):
    scans = {"S2": "S3", "S3": "S2"}
    changed_rows(job / "targets.csv", lambda row: row.update(scan=scans.get(row["scan"], row["scan"])))


def files_under_the_wrong_scan(job):
    def change(plan):
        second, third = plan["scans"][1:3]
        second["file"], third["file"] = third["file"], second["file"]
    changed_job(job, change)


def three_control_points_and_one_is_wrong(job):
    for name in ("control.csv", "targets.csv"):
        changed_rows(job / name, lambda row: row["id"] in ("T103", "T105", "T106"))
    control_point_ten_centimetres_off(job)


def control_east_and_north_exchanged(job):
    changed_rows(job / "control.csv", lambda row: exchanged(row, "east", "north"))


def all_control_a_hundred_metres_north(job):
    changed_rows(job / "control.csv", lambda row: moved(row, "north", 100.0))


def control_one_per_mille_too_long(job):
    """Grid instead of ground distances, or the other way round."""
    first = rows_of(job / "control.csv")[0]
    for key in ("east", "north"):
        changed_rows(job / "control.csv",
                     lambda row: moved(row, key, 0.001 * (float(row[key]) - float(first[key]))))


def poses_east_and_north_exchanged(job):
    def change(plan):
        without_control(plan)
        for scan in plan["scans"]:
            exchanged(scan["pose"]["position"], 0, 1)
    changed_job(job, change)


def all_ten_kilometres_east(job):
    def change(plan):
        without_control(plan)
        for scan in plan["scans"]:
            scan["pose"]["position"][0] += 10000.0
    changed_job(job, change)


def guess_five_metres_off(job):
    def change(plan):
        without_control(plan)
        plan["scans"][1]["pose"]["position"][0] += 5.0
    changed_job(job, change)


def guess_far_off_and_turned(job):
    def change(plan):
        without_control(plan)
        pose = plan["scans"][1]["pose"]
        pose["position"][1] += 8.0
        turns = pose.get("yaw_pitch_roll_deg", [0.0, 0.0, 0.0])
        pose["yaw_pitch_roll_deg"] = [(turns[0] + 200.0) % 360.0] + turns[1:]
    changed_job(job, change)


def neither_control_nor_guess(job):
    def change(plan):
        without_control(plan)
        for scan in plan["scans"]:
            del scan["pose"]
    changed_job(job, change)


def two_targets_no_guess_and_no_design(job):
    def change(plan):
        for key in ("alignment", "profile", "profiles", "lines", "chainage", "rounds"):
            plan.pop(key, None)
        for scan in plan["scans"]:
            del scan["pose"]
    changed_job(job, change)
    write_rows(job / "targets.csv", rows_of(job / "targets.csv")[:2])


def scan_one_per_mille_too_large(job):
    """As with a wrong correction for the air, or feet that are not quite feet."""
    file = job / "scans/S2.ply"
    head, _, points = file.read_bytes().partition(b"end_header\n")
    size = sum({b"float": 4, b"ushort": 2, b"uchar": 1}[line.split()[1]] for line in head.splitlines()
               if line.startswith(b"property"))
    scaled = bytearray(points)
    for at in range(0, len(points), size):
        struct.pack_into("<3f", scaled, at, *(1.001 * x for x in struct.unpack_from("<3f", points, at)))
    file.write_bytes(head + b"end_header\n" + scaled)


def no_control(job):
    changed_job(job, without_control)


def the_same_scan_twice(job):
    shutil.copy(job / "scans/S1.ply", job / "scans/S2.ply")


def more_chainage_than_was_scanned(job):
    changed_job(job, lambda plan: plan["chainage"].update({"from": 1005.0, "to": 1085.0}))


# change, last command, exit code, what must be said, what must not be said, whether the poses stay true
CASES = [
    (control_point_ten_centimetres_off, "register", 1, r"control point T105: contradicts .* left out", r"pair .*left out|targets? ", True),
    (target_eight_centimetres_off, "register", 1, r"target T106 of scan S2: contradicts .* left out", r"pair .*left out|(^|\n)(control )?point", True),
    (two_target_names_exchanged, "register", 1, r"targets of scan S3: contradicts .* names are exchanged", r"pair .*left out|point T", True),
    (targets_under_the_wrong_scan, "register", 1, r"targets of scan S[23]: contradicts .*; check whether they are filed under", r"pair .*left out", True),
    (files_under_the_wrong_scan, "register", 1, r"pair S3 - S2: contradicts .* the file of its station", None, False),
    (three_control_points_and_one_is_wrong, "register", 1, r"control point T105 contradicts .* too little control", r"pair .*left out", False),
    (control_east_and_north_exchanged, "register", 2, r"control\.csv: .* km from the axis; .*swapped", None, False),
    (all_control_a_hundred_metres_north, "register", 1, r"control: all 3 scans with a guess stand (99|100)\.\d m from it, one way", None, False),
    (control_one_per_mille_too_long, "register", 1, r"control and scans contradict one another|contradicts|times what its sigma", None, False),
    (poses_east_and_north_exchanged, "register", 2, r"job\.json: scans.* swapped", None, False),
    (all_ten_kilometres_east, "register", 1, r"scan S1: stands \d+ m from the axis, far from the tunnel", None, False),
    (all_ten_kilometres_east, "surface", 2, r"no point of the scans lies near .*: scan S1 stands \d+ m from the axis", None, False),
    (guess_five_metres_off, "register", 1, r"scan S2: its guess is \d\.\d\d m .* set aside", None, False),
    (guess_far_off_and_turned, "register", 1, r"scan S2: its guess is [89]\.\d\d m and 1[56]\d\.\d degrees .* set aside", r"pair ", False),
    (neither_control_nor_guess, "volume", 1, r"datum: neither .* coordinates are those of scan S1", r"axis", False),
    (two_targets_no_guess_and_no_design, "register", 1, r"datum: there is no guess, and the targets do not tie", r"neither", False),
    (scan_one_per_mille_too_large, "register", 1, r"pair S\d - S\d: S\d shows everything (0\.9[5-9]|1\.0[0-5]) per mille", None, False),
    (no_control, "register", 1, r"datum: .*for no control point is seen in the scans", None, False),
    (the_same_scan_twice, "register", 1, r"S2.* same ", None, False),
    (more_chainage_than_was_scanned, "profile", 1, r"coverage: only \d+ % of the stretch was seen", None, False),
]


def sayings(job, done):
    """The error, or every finding that asks for a person."""
    if done.returncode == 2:
        return [done.stderr.decode("utf-8", "replace").strip()]
    results = json.loads((job / "out/results.json").read_text())
    return ["%s: %s; %s" % (f["subject"], f["words"], f["mend"]) for f in results["findings"] if f["severity"] == "decision"]


def faults_of(program, job, case):
    _, command, code, wanted, unwanted, true_poses = case
    done = small_job.adit(program, command, job, "--quiet")
    said = sayings(job, done)
    text = "\n".join(said)
    faults = ["exit %d, expected %d" % (done.returncode, code) if done.returncode != code else "",
              "does not say " + wanted if not re.search(wanted, text) else "",
              "says " + unwanted if unwanted and re.search(unwanted, text) else ""]
    if true_poses and done.returncode != 2:
        error_mm = json.loads((job / "out/results.json").read_text())["truth"]["worst_position_error_mm"]
        faults.append("poses are %.1f mm off" % error_mm if error_mm > 5.0 else "")
    faults = [f for f in faults if f]
    if faults or "-v" in sys.argv:
        print("  " + "\n  ".join(said))
    return faults


def stale_report(program, plain, folder):
    """Numbers that are newer than the report beside them: adit says so, and keeps the report."""
    job = small_job.copied(plain, folder / "job")
    small_job.run(program, job)
    before = (job / "out/report.pdf").read_bytes()
    small_job.adit(program, "volume", job, "--quiet")
    calm = json.loads((job / "out/results.json").read_text())["findings"]
    changed_job(job, lambda plan: plan["lines"][1].update(offset=0.3))
    small_job.adit(program, "volume", job, "--quiet")
    warned = json.loads((job / "out/results.json").read_text())["findings"]
    named = [f for f in warned if f["subject"] == "report.pdf" and "earlier run" in f["words"]]
    changed_job(job, lambda plan: [plan.pop(key) for key in ("alignment", "profile", "lines", "chainage", "rounds")])
    small_job.adit(program, "register", job, "--quiet")
    undesigned = {f["subject"] for f in json.loads((job / "out/results.json").read_text())["findings"] if "earlier run" in f["words"]}
    return ["names only %s of an earlier run once the design is gone" % sorted(undesigned)
            if not undesigned >= {"sections.csv", "volumes.csv", "report.pdf"} else "",
            "warns of a report that is up to date" if any(f["subject"] == "report.pdf" for f in calm) else "",
            "says nothing of an old report" if not named else "",
            "the report was touched" if (job / "out/report.pdf").read_bytes() != before else ""]


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    words = [w for w in sys.argv[2:] if w != "-v"]
    tally = small_job.Tally()
    with tempfile.TemporaryDirectory(prefix="adit-wrong-") as temporary:
        folder = pathlib.Path(temporary)
        plain = folder / "plain"
        done = small_job.adit(program, "demo", plain, *DEMO, "--no-run", "--quiet")
        if done.returncode != 0:
            sys.exit("adit demo failed: " + done.stderr.decode())
        for case in CASES:
            name = case[0].__name__.replace("_", " ") + " (%s)" % case[1]
            if words and not any(w in name for w in words):
                continue
            job = small_job.copied(plain, folder / "job")
            case[0](job)
            tally.check(name, faults_of(program, job, case))
        if not words:
            tally.check("a report from an earlier run", stale_report(program, plain, folder))
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
