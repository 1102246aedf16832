#!/usr/bin/env python3
"""Damage to what earlier runs left, and two runs at once: damaged_out.py ADIT

Whatever is cut short, changed by a bit, emptied or removed in out/: the following run says nothing, mends it, and ends
with the same results and the same bytes."""
import pathlib
import subprocess
import sys
import tempfile
import time

import small_job


def cut_short(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def one_bit_changed(path, at=0.5):
    content = bytearray(path.read_bytes())
    content[int(at * (len(content) - 1))] ^= 0x01
    path.write_bytes(content)


def first_bit_changed(path):
    one_bit_changed(path, 0.0)


def last_bit_changed(path):
    one_bit_changed(path, 1.0)


def emptied(path):
    path.write_bytes(b"")


def removed(path):
    path.unlink()



DAMAGE = [cut_short, one_bit_changed, first_bit_changed, last_bit_changed, emptied, removed]


def victims(out):
    every = [p for p in sorted(out.rglob("*")) if p.is_file() and p.name != ".lock"]
    pictures = [p for p in every if p.parent.name == "report"]
    return [p for p in every if p not in pictures[1:]]


def damage_each(program, job, expected, tally):
    out = job / "out"
    whole = small_job.files(out)
    for number, path in enumerate(victims(out)):
        kinds = DAMAGE if path.parent.name in ("import", "steps") and path.suffix != ".key" else DAMAGE[number % 2::3]
        for damage in kinds:
            damage(path)
            name = "%s %s" % (path.relative_to(out), damage.__name__)
            done = small_job.adit(program, "run", job, "--quiet")
            after = small_job.files(out)
            tally.check(name, ["exit %d" % done.returncode if done.returncode not in (0, 1) else "",
                               "said " + done.stderr.decode() if done.stderr else "",
                               "other results" if small_job.lasting(job) != expected else "",
                               *(n + " differs" for n in whole if after.get(n) != whole[n])])


def stale_temporaries(program, job, tally):
    """What a killed process left goes; what a living one writes stays."""
    gone = subprocess.Popen(["true"])
    gone.wait()
    left = [job / "out" / sub / (".x.adit-%d-0.tmp" % gone.pid) for sub in ("", "steps", "import", "report")]
    living = job / "out" / ".x.adit-1-0.tmp"
    for path in [*left, living]:
        path.write_text("half")
    small_job.run(program, job)
    tally.check("stale temporaries go", ["still there: " + str(p) for p in left if p.exists()] +
                ["one of a living process went" if not living.exists() else ""])
    living.unlink()


def two_at_once(program, plain, expected, folder, tally):
    job = small_job.copied(plain, folder / "twice")
    first = subprocess.Popen([program, "run", str(job), "--quiet"], stderr=subprocess.PIPE, env=small_job.ENVIRONMENT)
    while not (job / "out/steps").exists() and first.poll() is None:
        time.sleep(0.01)
    second = small_job.adit(program, "run", job, "--quiet")
    elsewhere = small_job.adit(program, "run", job, "--quiet", "--out", folder / "elsewhere")
    said = first.communicate()[1]
    tally.check("two runs at once", [
        "the second: exit %d, %r" % (second.returncode, second.stderr)
        if second.returncode != 2 or b"another run is writing to this folder; wait for it to end" not in second.stderr else "",
        "the first: exit %d, %r" % (first.returncode, said) if first.returncode not in (0, 1) or said else "",
        "elsewhere: exit %d" % elsewhere.returncode if elsewhere.returncode not in (0, 1) else "",
        "other results" if small_job.lasting(job) != expected else "",
        "other results elsewhere" if small_job.lasting(folder, "elsewhere") != expected else ""])


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    tally = small_job.Tally()
    with tempfile.TemporaryDirectory(prefix="adit-damaged-") as temporary:
        folder = pathlib.Path(temporary)
        plain = folder / "plain"
        small_job.make_demo(program, plain)
        job = small_job.copied(plain, folder / "job")
        small_job.run(program, job)
        expected = small_job.lasting(job)
        damage_each(program, job, expected, tally)
        stale_temporaries(program, job, tally)
        two_at_once(program, plain, expected, folder, tally)
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
