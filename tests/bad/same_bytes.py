#!/usr/bin/env python3
"""The same job on 1, 2 and 5 threads gives the same bytes: same_bytes.py ADIT"""
import pathlib
import sys
import tempfile

import small_job


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    tally = small_job.Tally()
    with tempfile.TemporaryDirectory(prefix="adit-threads-") as temporary:
        folder = pathlib.Path(temporary)
        job = folder / "job"
        small_job.make_demo(program, job)
        for threads in ("1", "2", "5"):
            small_job.run(program, job, "--threads", threads, "--out", folder / threads)
        one = small_job.files(folder / "1")
        for threads in ("2", "5"):
            other = small_job.files(folder / threads)
            tally.check("results on %s threads" % threads,
                        ["results.json differs"] if small_job.lasting(folder, threads) != small_job.lasting(folder, "1") else [])
            for name in sorted(set(one) | set(other)):
                tally.check("%s on %s threads" % (name, threads), ["differs"] if one.get(name) != other.get(name) else [])
    return tally.end()


if __name__ == "__main__":
    sys.exit(main())
