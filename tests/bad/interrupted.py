#!/usr/bin/env python3
"""Ctrl-C and kill -9 at moments spread over a run: interrupted.py ADIT

Ctrl-C ends with exit code 130 within LONGEST_S, says one line and leaves no temporary file. After either, a run that is
let be ends with the same results as one that was never disturbed.
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import small_job

LONGEST_S = 1.5
MOMENTS = 10


def is_ending(pid):
    """It has given its exit code already and only frees its memory: no signal changes that (proc(5): PF_EXITING)."""
    state = pathlib.Path("/proc/%d/stat" % pid).read_text().rpartition(")")[2].split()
    return state[0] in "ZX" or bool(int(state[6]) & 0x4)


def disturbed(command, after_s, by):
    """Exit code (None: it had ended before), seconds from signal to end, words."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, env=small_job.ENVIRONMENT)
    try:
        process.wait(after_s)
        process.communicate()
        return None, 0.0, ""
    except subprocess.TimeoutExpired:
        pass
    if is_ending(process.pid):
        process.communicate()
        return None, 0.0, ""
    start = time.monotonic()
    process.send_signal(by)
    said = process.communicate(timeout=60)[1].decode("utf-8", "replace")
    return process.returncode, time.monotonic() - start, said


def faults_of(code, seconds, said, by, folder):
    if code is None:
        return []
    if by == signal.SIGKILL:
        return ["exit %d after kill -9" % code] if code != -signal.SIGKILL else []
    not_begun = code == -by and not folder.exists()  # the program was still being loaded
    return ["exit %d" % code if code not in (130, 0, 1) and not not_begun else "",  # 0 and 1: it had all but ended
            "answered after %.2f s" % seconds if seconds > LONGEST_S else "",
            "said %r" % said if code == 130 and said != "adit: cancelled; finished steps are kept\n" else ""]


def duration(command):
    start = time.monotonic()
    subprocess.run(command, check=False, capture_output=True, env=small_job.ENVIRONMENT)
    return time.monotonic() - start


def disturb_runs(program, plain, expected, folder, tally):
    """Every moment on a fresh copy, and then all of them on one that keeps what it has."""
    whole_s = duration([program, "run", str(small_job.copied(plain, folder / "timed")), "--quiet"])
    cancelled = 0
    for by in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        for k in range(MOMENTS if by == signal.SIGINT else MOMENTS // 2):
            job = small_job.copied(plain, folder / "job")
            after_s = whole_s * (k + 0.5) / (MOMENTS if by == signal.SIGINT else MOMENTS // 2)
            code, seconds, said = disturbed([program, "run", str(job), "--quiet"], after_s, by)
            cancelled += code == 130
            faults = faults_of(code, seconds, said, by, job / "out")
            if by != signal.SIGKILL:
                faults += ["left " + name for name in small_job.temporaries(job)]
            small_job.run(program, job)
            faults += ["left " + name for name in small_job.temporaries(job)]
            if small_job.lasting(job) != expected:
                faults.append("the run after it gave other results")
            tally.check("%s after %.2f s of a run" % (by.name, after_s), faults)
    tally.check("some runs were cancelled", [] if cancelled >= 3 else ["only %d were" % cancelled])


def disturb_one_job_often(program, plain, expected, folder, tally):
    job = small_job.copied(plain, folder / "often")
    faults = []
    for k in range(12):
        code, seconds, said = disturbed([program, "run", str(job), "--quiet"], 0.15 * (k + 1), signal.SIGINT if k % 2 else signal.SIGKILL)
        faults += faults_of(code, seconds, said, signal.SIGINT if k % 2 else signal.SIGKILL, job / "out")
    small_job.run(program, job)
    if small_job.lasting(job) != expected:
        faults.append("other results")
    tally.check("a job disturbed again and again", faults)


def disturb_demos(program, plain, folder, tally):
    def command(demo):
        return [program, "demo", str(demo), *small_job.DEMO, "--no-run", "--quiet"]

    whole_s = duration(command(folder / "timed_demo"))
    expected = small_job.files(plain)
    for by in (signal.SIGINT, signal.SIGKILL):
        for k in range(6):
            demo = folder / ("demo_%s_%d" % (by.name, k))
            code, seconds, said = disturbed(command(demo), whole_s * (k + 0.5) / 6, by)
            faults = faults_of(code, seconds, said, by, demo)
            if by == signal.SIGINT:
                faults += ["left " + name for name in small_job.temporaries(demo)]
            if code == 130 and (demo / "job.json").exists():
                faults.append("half a demo has a job.json")
            again = subprocess.run(command(demo), capture_output=True, env=small_job.ENVIRONMENT)
            if again.returncode != 0:
                faults.append("the demo after it failed: " + again.stderr.decode())
            elif small_job.files(demo) != expected:
                faults.append("the demo after it differs")
            tally.check("%s in a demo, moment %d" % (by.name, k + 1), faults)


def stores(job):
    return {p.name: p.read_bytes() for p in sorted((job / "out" / "import").glob("*.points"))}


def kill_imports(program, folder, tally):
    """Ten kills of one import at random moments, one after the other, then the run: the bytes of one that was let be."""
    random.seed(4)
    plain = folder / "import_plain"
    small_job.adit(program, "demo", plain, "--points", "300000", "--stations", "2", "--no-run", "--quiet")
    job_json = json.loads((plain / "job.json").read_text())
    for scan in job_json["scans"]:  # text takes longer to read
        text = scan["file"].replace(".ply", ".xyz")
        small_job.adit(program, "convert", plain / scan["file"], plain / text, "--quiet")
        scan["file"] = text
    (plain / "job.json").write_text(json.dumps(job_json))
    calm = small_job.copied(plain, folder / "import_calm")
    whole_s = duration([program, "import", str(calm), "--quiet"])
    small_job.run(program, calm)
    job = small_job.copied(plain, folder / "import_killed")
    killed = 0
    for _ in range(10):
        code, _, _ = disturbed([program, "import", str(job), "--quiet"], random.uniform(0.05, 1.0) * whole_s, signal.SIGKILL)
        killed += code == -signal.SIGKILL
    small_job.run(program, job)
    tally.check("ten imports killed", ["only %d were" % killed if killed < 3 else "",
                                       "other stores" if stores(job) != stores(calm) else "",
                                       "other results" if small_job.lasting(job) != small_job.lasting(calm) else "",
                                       *["left " + name for name in small_job.temporaries(job)]])


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    tally = small_job.Tally()
    with tempfile.TemporaryDirectory(prefix="adit-interrupted-") as temporary:
        folder = pathlib.Path(temporary)
        plain = folder / "plain"
        small_job.make_demo(program, plain)
        calm = small_job.copied(plain, folder / "calm")
        small_job.run(program, calm)
        expected = small_job.lasting(calm)
        disturb_runs(program, plain, expected, folder, tally)
        disturb_one_job_often(program, plain, expected, folder, tally)
        disturb_demos(program, plain, folder, tally)
        kill_imports(program, folder, tally)
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
