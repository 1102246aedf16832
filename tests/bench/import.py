#!/usr/bin/env python3
"""Import at survey scale: ours and its peers on the same files in the same run. ./dev bench import [MILLIONS] [JOB]

Makes a simulated job of MILLIONS points (20) in ten scans, or takes the one in the folder JOB, writes it as LAS, LAZ and E57 too,
and prints the tables of docs/performance.md. Peers: cat FILES | sha256sum, the libraries' own decoding loops, and CloudCompare on one
scan of 20 million points (or MILLIONS, if less).
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ADIT = ROOT / "build/release/app/adit"
BENCH = ROOT / "build/release/tests/adit_bench"


def timed(command, **more):
    """Seconds and peak memory [MiB] of a command that must end well."""
    start = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **more)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    # Of adit 1 is a run that ended and left findings.
    if os.waitstatus_to_exitcode(status) not in ((0, 1) if command[0] == ADIT else (0,)):
        sys.exit(f"{command[0]} failed: {said.decode()}")
    return time.monotonic() - start, usage.ru_maxrss / 1024


def read_once(files):
    """So that the first to be measured does not wait for the disk."""
    for file in files:
        with open(file, "rb") as stream:
            while stream.read(1 << 24):
                pass


def hashing(files):
    """Seconds of cat FILES | sha256sum."""
    start = time.monotonic()
    subprocess.run(["bash", "-c", 'cat "$@" | sha256sum', "-", *map(str, files)], check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - start


def made_job(folder, millions, scans=10):
    timed([ADIT, "demo", folder, "--points", int(millions / scans * 1e6 / 0.976), "--stations", scans, "--no-run", "--quiet"])
    return folder


def job_with(job, ending, folder):
    """The same job with its scans in another format."""
    content = json.loads((job / "job.json").read_text())
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "scans").mkdir(parents=True)
    for name in ("axis.xml", "profile.dxf", "control.csv", "targets.csv"):
        shutil.copy(job / name, folder / name)
    for scan in content["scans"]:
        source = job / scan["file"]
        scan["file"] = "scans/" + scan["name"] + ending
        if source.suffix == ending:
            os.symlink(source.resolve(), folder / scan["file"])
        else:
            timed([ADIT, "convert", source, folder / scan["file"], "--quiet"])
    (folder / "job.json").write_text(json.dumps(content))
    return [folder / scan["file"] for scan in content["scans"]]


def imported(folder):
    shutil.rmtree(folder / "out", ignore_errors=True)
    return timed([ADIT, "import", folder, "--quiet"])


def import_table(job, folder):
    print("\n### Import against its peers\n")
    print("| files | GB | points, million | peer | peer s | adit import s | ratio | MiB |\n|---|---|---|---|---|---|---|---|")
    for ending in (".ply", ".las", ".laz", ".e57"):
        own = folder / ending[1:]
        files = job_with(job, ending, own)
        read_once(files)
        size = sum(file.stat().st_size for file in files)
        if ending in (".ply", ".las"):
            peer, peer_s = "sha256sum", hashing(files)
        else:
            peer = "the library's loop"
            peer_s = sum(timed([BENCH, "decoding", file])[0] for file in files)
        own_s, memory = imported(own)
        points = sum(row["points"] for row in json.loads((own / "out/results.json").read_text())["inputs"])
        print(f"| {ending[1:].upper()} | {size / 1e9:.2f} | {points / 1e6:.1f} | {peer} | {peer_s:.1f} | {own_s:.1f} | {own_s / peer_s:.2f} | {memory:.0f} |", flush=True)
        if ending != ".ply":
            shutil.rmtree(own)
    return folder / "ply"


def section_table(job):
    timed([ADIT, "register", job, "--quiet"])
    print("\n### Sections straight from the points\n")
    print("| points, million | index s | one section s | a thousand s |\n|---|---|---|---|")
    print(subprocess.run([BENCH, "sections", job], check=True, capture_output=True, text=True).stdout, end="", flush=True)


def cloudcompare_table(folder, millions):
    """One file: load and one slice. Debian's CloudCompare reads no LAS, so it gets the same points as binary PLY."""
    print("\n### One file and one slice against CloudCompare\n")
    program = shutil.which("CloudCompare") or shutil.which("cloudcompare.CloudCompare") or shutil.which("cloudcompare")
    if not program:
        print("CloudCompare is not installed (Debian's package cloudcompare): not measured.")
        return
    job = made_job(folder / "one", millions, scans=1)
    print("| program | file | s | MiB |\n|---|---|---|---|")
    for ending in (".ply", ".las"):
        own = folder / ("one-" + ending[1:])
        (file,) = job_with(job, ending, own)
        read_once([file])
        if ending == ".ply":
            peer_s, memory = timed([program, "-SILENT", "-AUTO_SAVE", "OFF", "-O", file, "-CROP", "2:-100:-100:2.1:100:100"],
                                   env=dict(os.environ, QT_QPA_PLATFORM="offscreen"), cwd=folder)
            print(f"| CloudCompare | PLY | {peer_s:.1f} | {memory:.0f} |", flush=True)
        own_s, memory = timed([BENCH, "slice", own])
        print(f"| Adit | {ending[1:].upper()} | {own_s:.1f} | {memory:.0f} |", flush=True)


def main():
    millions = float(sys.argv[1]) if len(sys.argv) > 1 else 20.0
    with tempfile.TemporaryDirectory(prefix="adit-bench-", dir=os.environ.get("ADIT_BENCH_FOLDER")) as temporary:
        folder = pathlib.Path(temporary)
        job = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else made_job(folder / "job", millions)
        plain = import_table(job, folder)
        cloudcompare_table(folder, min(millions, 20.0))
        section_table(plain)


if __name__ == "__main__":
    main()
