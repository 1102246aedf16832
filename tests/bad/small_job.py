"""What the tests of disturbed runs share: a small demo, and results without what differs from run to run."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

ENVIRONMENT = dict(os.environ, SOURCE_DATE_EPOCH="1750000000")
DEMO = ["--points", "60000", "--stations", "2"]


def adit(program, *words, **more):
    return subprocess.run([program, *map(str, words)], capture_output=True, stdin=subprocess.DEVNULL, env=ENVIRONMENT, timeout=300, **more)


def make_demo(program, folder):
    done = adit(program, "demo", folder, *DEMO, "--no-run", "--quiet")
    if done.returncode != 0:
        sys.exit("adit demo failed: " + done.stderr.decode())


def run(program, job, *words):
    done = adit(program, "run", job, "--quiet", *words)
    if done.returncode not in (0, 1) or done.stderr:
        sys.exit("an undisturbed run failed: %d %s" % (done.returncode, done.stderr.decode()))


def copied(job, to):
    shutil.rmtree(to, ignore_errors=True)
    return pathlib.Path(shutil.copytree(job, to, symlinks=True))


def lasting(job, out="out"):
    """results.json without times and memory."""
    results = json.loads((pathlib.Path(job) / out / "results.json").read_text())
    for key in ("timing_s", "pair_timing_s", "peak_memory_bytes"):
        results.pop(key, None)
    return results


def files(folder):
    """Every derived file and its bytes; the lock, the records and results.json, which holds times, are left out."""
    folder = pathlib.Path(folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and p.name not in (".lock", "results.json") and p.suffix != ".key"}


def temporaries(folder):
    return [str(p) for p in pathlib.Path(folder).rglob("*.tmp")]


class Tally:
    def __init__(self):
        self.passed = self.failed = 0

    def check(self, name, faults):
        faults = [f for f in faults if f]
        self.passed += not faults
        self.failed += bool(faults)
        if faults:
            print("FAILED %s: %s" % (name, "; ".join(faults)), flush=True)
        elif "-v" in sys.argv:
            print("passed " + name, flush=True)

    def end(self):
        print("%d passed, %d failed" % (self.passed, self.failed))
        return 1 if self.failed else 0
