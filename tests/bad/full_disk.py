#!/usr/bin/env python3
"""A disk without space: full_disk.py ADIT. Exit code 2, one line that names the file and says "free some space", no
temporary file, and what was there before stays as it was. Small disks in memory where they may be mounted (root), and a
limit on the size of files everywhere."""
import contextlib
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import small_job


@contextlib.contextmanager
def disk(place, kilobytes):
    place.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=%dk" % kilobytes, "adit-test", str(place)], check=True, capture_output=True)
    try:
        yield place
    finally:
        subprocess.run(["umount", str(place)], check=True)


def may_mount(folder):
    try:
        with disk(folder / "trial", 64):
            return True
    except (OSError, subprocess.CalledProcessError):
        return False


def filled(place):
    """A file that takes all the space there is."""
    with open(place / "filler", "wb", buffering=0) as filler:
        with contextlib.suppress(OSError):
            while filler.write(b"x" * 4096):
                pass
    return place / "filler"


def faults_of(done, place):
    said = done.stderr.decode("utf-8", "replace")
    return ["exit %d: %s" % (done.returncode, said) if done.returncode != 2 else "",
            "said " + repr(said) if not re.fullmatch(r"adit: [^\n]*%s[^\n]*; free some space[^\n]*\n" % re.escape(str(place)), said) else "",
            *("left " + name for name in small_job.temporaries(place))]


def small_disks(program, plain, folder, tally):
    """Space for a little more each time, until a run fits."""
    expected = None
    for kilobytes in [4, 12, 300, 700, 1200, 1500, 2000, 2400, 2800, 3200, 3600, 4000, 6000, 40000]:
        with disk(folder / "disk", kilobytes) as place:
            done = small_job.adit(program, "run", plain, "--quiet", "--out", place / "out")
            name = "run on a disk of %d kB" % kilobytes
            if done.returncode in (0, 1):
                expected = small_job.lasting(place)
                tally.check(name + " (fits)", [])
                continue
            tally.check(name, faults_of(done, place) + ["half a results.json" if (place / "out/results.json").exists() else ""])
    return expected


def filled_up_later(program, plain, folder, tally):
    job = small_job.copied(plain, folder / "job")
    with disk(folder / "disk", 60000) as place:
        small_job.run(program, job, "--out", place / "out")
        before = small_job.files(place / "out")
        first = (place / "out/results.json").read_bytes()
        filler = filled(place)
        plan = json.loads((job / "job.json").read_text())
        plan["chainage"]["interval"] = 2.0
        plan["options"] = {"surface": {"spacing_m": 0.25}}
        (job / "job.json").write_text(json.dumps(plan))
        done = small_job.adit(program, "run", job, "--quiet", "--out", place / "out")
        after = small_job.files(place / "out")
        tally.check("a run on a disk that has filled up", faults_of(done, place) +
                    [name + " was changed" for name in before if after.get(name) != before[name]] +
                    ["results.json was changed" if (place / "out/results.json").read_bytes() != first else ""])
        done = small_job.adit(program, "convert", job / "scans/S1.ply", place / "S1.las", "--quiet")
        tally.check("convert on a full disk", faults_of(done, place) + ["wrote half" if (place / "S1.las").exists() else ""])
        done = small_job.adit(program, "demo", place / "demo", *small_job.DEMO, "--no-run", "--quiet")
        tally.check("demo on a full disk", faults_of(done, place))
        filler.unlink()
        small_job.run(program, job, "--out", place / "out")
        small_job.run(program, job)
        tally.check("the run after space was made", ["other results"] if small_job.lasting(place) != small_job.lasting(job) else [])


def limited_files(program, plain, folder, tally):
    for kilobytes in (1, 100, 500, 900):
        out = folder / ("limited_%d" % kilobytes)
        limit = kilobytes * 1024
        done = small_job.adit(program, "run", plain, "--quiet", "--out", out,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        tally.check("files of at most %d kB" % kilobytes, faults_of(done, out))


def limited_converts(program, plain, folder, tally):
    """A disk that ends anywhere in the file, in its last bytes, too."""
    for ending in ("ply", "pcd", "las", "laz", "e57", "ptx"):
        whole = folder / ("whole." + ending)
        if small_job.adit(program, "convert", plain / "scans/S1.ply", whole, "--quiet").returncode != 0:
            continue  # a format that this build lacks
        size = whole.stat().st_size
        for limit in (0, 100, 380, size // 2, size - 4096, size - 300, size - 100, size - 20, size - 8, size - 1):
            place = folder / "limited"
            place.mkdir(exist_ok=True)
            done = small_job.adit(program, "convert", plain / "scans/S1.ply", place / ("S1." + ending), "--quiet",
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
            tally.check("convert to %s, %d bytes of %d" % (ending, limit, size), faults_of(done, place))


def full_output(program, plain, tally):
    if not os.path.exists("/dev/full"):
        return
    with open("/dev/full", "wb") as full:
        done = subprocess.run([program, "info", str(plain / "axis.xml"), "--json"], stdout=full, stderr=subprocess.PIPE)
    tally.check("standard output on a full disk", [] if done.returncode == 2 and b"free some space" in done.stderr else [repr(done)])


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    tally = small_job.Tally()
    with tempfile.TemporaryDirectory(prefix="adit-full-") as temporary:
        folder = pathlib.Path(temporary)
        plain = folder / "plain"
        small_job.make_demo(program, plain)
        full_output(program, plain, tally)
        limited_files(program, plain, folder, tally)
        limited_converts(program, plain, folder, tally)
        if may_mount(folder):
            small_disks(program, plain, folder, tally)
            filled_up_later(program, plain, folder, tally)
        else:
            print("skipped small disks: mounting one is not permitted here")
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
