#!/usr/bin/env python3
"""Broken inputs: run.py ADIT [WORD...] runs every case whose name holds one of the words (all cases without a word).

A case is a folder here with a file `expect`; its other files are laid over a copy of base/, a small job that is good.
    command WORDS     what is typed after "adit" in that folder; "run ." without this line
    exit CODE         2 where this line is missing
    message REGEX     found in the one line that adit says on stderr; none: adit must say nothing
    output REGEX      found on stdout
    leaves FILE       must be there afterwards
    changes FILE      an input that the command may write
    make KIND NAME [WORDS]    a file made for the case; kinds are the functions of broken.py
    needs ENDING      a format that a build may lack; left out where it does
    user              needs a user who is not root: root runs it as nobody
    # ...             why
patch.json, where a case has one, is merged into the base's job.json (RFC 7396: null removes a key).
A failed run must leave no results, no temporary file, and every input as it was.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import broken

HERE = pathlib.Path(__file__).resolve().parent
LINE = re.compile(r"^adit: [^;]+: .+; .+$")
LONGEST_S = 120
NOBODY = 65534


class Case:
    def __init__(self, folder):
        self.name = folder.name
        self.folder = folder
        self.command, self.exit, self.message, self.output = "run .", 2, None, None
        self.leaves, self.changes, self.make, self.user, self.needs = [], [], [], False, None
        for number, line in enumerate((folder / "expect").read_text().splitlines(), 1):
            key, _, words = line.strip().partition(" ")
            if not key or key.startswith("#"):
                continue
            if key in ("leaves", "changes"):
                getattr(self, key).append(words)
            elif key == "make":
                self.make.append(shlex.split(words))
            elif key == "user":
                self.user = True
            elif key == "exit":
                self.exit = int(words)
            elif key in ("command", "message", "output", "needs"):
                setattr(self, key, words)
            else:
                sys.exit("%s/expect:%d: unknown word %s" % (folder, number, key))


def merged(into, patch):
    if not isinstance(patch, dict) or not isinstance(into, dict):
        return patch
    result = dict(into)
    for key, value in patch.items():
        if value is None:
            result.pop(key, None)
        else:
            result[key] = merged(result.get(key, {}), value)
    return result


def prepared(case, job):
    """The case's copy of the base job, with its own files over it."""
    shutil.copytree(HERE / "base", job)
    (job / "scans").mkdir(exist_ok=True)
    broken.tunnel(job / "scans" / "S1.xyz")
    shutil.copytree(case.folder, job, dirs_exist_ok=True)
    (job / "expect").unlink()
    if (job / "patch.json").exists():
        plain = json.loads((job / "job.json").read_text())
        (job / "job.json").write_text(json.dumps(merged(plain, json.loads((job / "patch.json").read_text())), indent=1))
        (job / "patch.json").unlink()
    for kind, name, *words in case.make:
        target = job / name
        target.parent.mkdir(parents=True, exist_ok=True)
        broken.KINDS[kind](target, *words)


def digest(path):
    if path.is_symlink():
        return "link to " + os.readlink(path)
    if not path.is_file() or not os.access(path, os.R_OK):
        return "no plain file"
    return hashlib.sha256(path.read_bytes()).hexdigest()


def tree(folder):
    return {str(p.relative_to(folder)): digest(p) for p in sorted(folder.rglob("*")) if p.is_symlink() or not p.is_dir()}


FINISHED = re.compile(r"(^|/)out/(\.lock|import/[^/]+\.points|steps/[a-z]+\.(key|json)|steps/map\.bin|mesh\.ply)$")


def left_behind(before, after, failed, may_change):
    """What a run must not do to a folder."""
    faults = [name + " was changed" for name in before if after.get(name) != before[name] and name not in may_change]
    for name in after:
        if re.search(r"\.tmp$", name):
            faults.append("temporary file left: " + name)
        elif failed and name not in before and not FINISHED.search(name):
            faults.append("left after a failure: " + name)
    return faults


def faults_of_words(case, done):
    said = done.stderr.decode("utf-8", "replace")
    faults = []
    if done.returncode != case.exit:
        faults.append("exit %d, expected %d" % (done.returncode, case.exit))
    if case.message is None:
        if said:
            faults.append("says what it should not")
    else:
        if said.count("\n") != 1 or not LINE.match(said.rstrip("\n")):
            faults.append("not one line of the form 'adit: where: what; mend'")
        if not re.search(case.message, said):
            faults.append("expected " + case.message)
    if case.exit == 2 and done.stdout and case.output is None:
        faults.append("prints on stdout")
    if case.output is not None and not re.search(case.output, done.stdout.decode("utf-8", "replace")):
        faults.append("stdout lacks " + case.output)
    return faults


def as_nobody(folder):
    """What subprocess needs for a user whose permissions count; the folder becomes his."""
    if os.geteuid() != 0:
        return {}
    for path in [pathlib.Path(folder), *pathlib.Path(folder).rglob("*")]:
        os.chown(path, NOBODY, NOBODY, follow_symlinks=False)
    return {"user": NOBODY, "group": NOBODY, "extra_groups": []}


def run(case, adit):
    with tempfile.TemporaryDirectory(prefix="adit-bad-") as temporary:
        job = pathlib.Path(temporary) / "job"
        prepared(case, job)
        before = tree(job)
        words = shlex.split(case.command)
        words[1:1] = ["--quiet"] if words and not words[0].startswith("-") and not re.search(r"usage", case.name) else []
        program = shutil.copy(adit, temporary) if case.user else adit  # nobody may not look into the build's folder
        nobody = as_nobody(temporary) if case.user else {}
        try:
            done = subprocess.run([program, *words], cwd=job, capture_output=True, timeout=LONGEST_S, stdin=subprocess.DEVNULL, **nobody)
        except subprocess.TimeoutExpired:
            return ["no answer in %d s" % LONGEST_S], ""
        faults = faults_of_words(case, done) + left_behind(before, tree(job), case.exit == 2, case.changes)
        faults += ["is not there: " + name for name in case.leaves if not (job / name).exists()]
        for path in job.rglob("*"):
            if path.is_dir() and not path.is_symlink():
                path.chmod(0o755)
        return faults, done.stderr.decode("utf-8", "replace")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    adit = str(pathlib.Path(sys.argv[1]).resolve())
    words = [w for w in sys.argv[2:] if w != "-v"]
    cases = [Case(p.parent) for p in sorted(HERE.glob("*/expect"))]
    cases = [c for c in cases if not words or any(w in c.name for w in words)]
    version = subprocess.run([adit, "--version"], capture_output=True, text=True).stdout
    cases = [c for c in cases if c.needs is None or c.needs not in version]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for case, (faults, said) in zip(cases, pool.map(lambda c: run(c, adit), cases)):
            failed += bool(faults)
            if faults:
                print("FAILED %s: %s\n       %s" % (case.name, "; ".join(faults), said.strip()))
            elif "-v" in sys.argv:
                print("%s: %s" % (case.name, said.strip()))
    print("%d passed, %d failed" % (len(cases) - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
