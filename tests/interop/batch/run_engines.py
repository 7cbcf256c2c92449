#!/usr/bin/env python3
"""The same batch by Slurm, by Snakemake and by `batch run`, with kills: the same bytes by all.

  run_engines.py PROGRAM WORK_FOLDER [--items 60] [--kills 3]

Says `skipped` with the reason of an engine that is not there. Ends with 1 where anything differs, is
lost, half or done twice.
"""

import argparse
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import time

import one_node_slurm

HERE = pathlib.Path(__file__).resolve().parent
BAD = 3


def batch(program, *words):
    return subprocess.run([program, "batch", *map(str, words)], check=True, capture_output=True,
                          text=True)


def plan(program, folder, shapes, chunk):
    shutil.rmtree(folder, ignore_errors=True)
    batch(program, "plan", shapes, "-o", folder, "--chunk", chunk, "--", "map", "--", "remesh",
          "--grid", "ico:3")


def results(folder):
    """Each item's files with their hashes; and the failures with their codes."""
    done = {}
    for record in sorted((folder / "results").glob("*/record.json")):
        done[record.parent.name] = json.loads(record.read_text())["files"]
    failed = {r.stem: json.loads(r.read_text())["code"] for r in (folder / "failed").glob("*.json")}
    return done, failed


def records(folder):
    return {r.parent.name: r.read_bytes() for r in (folder / "results").glob("*/record.json")}


def status(program, folder):
    return json.loads(batch(program, "status", folder, "--json", "-", "-q").stdout)


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def steps_of(folder):
    """Processes of a batch's runs, by the folder on their command lines."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
        except OSError:
            continue
        if b"batch" in words and os.fsencode(folder) in words:
            found.append(int(entry.name))
    return found


def wait_for_items(folder, count, run=None):
    """Until so many items are done, or there is nothing to wait for."""
    end = time.time() + 5
    while len(os.listdir(folder / "results")) < count and time.time() < end:
        if run and run.poll() is not None:
            return
        time.sleep(0.01)


def kill_some(pids, numbers):
    for pid in pids if numbers.random() < 0.5 else pids[:1]:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


class Checks:
    def __init__(self):
        self.bad = 0

    def __call__(self, name, good, what=""):
        print(f"{'ok ' if good else 'BAD'} {name}" + (f": {what}" if what and not good else ""),
              flush=True)
        self.bad += not good


def by_slurm(a, reference, check, numbers):
    reason = one_node_slurm.missing()
    if reason:
        print(f"skipped Slurm: {reason}")
        return
    folder = a.work / "slurm"
    plan(a.program, folder, a.work / "shapes", 10)
    with one_node_slurm.OneNodeSlurm(a.work / "one-node") as slurm:
        begin, seen, killed = time.time(), {}, {}
        for kill in range(a.kills):
            if not slurm.jobs():
                if status(a.program, folder)["done"] == a.items - BAD:
                    break
                batch(a.program, "retry", folder, "--code", "137")
                slurm.submit(folder / "array.sbatch")
            wait_for_items(folder, len(seen) + numbers.randint(2, 8))
            what = numbers.choice(("slurmd", "runs", "all")) if kill else "slurmd"
            killed[what] = killed.get(what, 0) + 1
            if what != "runs":
                slurm.kill_slurmd()
            if what != "slurmd":
                kill_some(steps_of(folder), numbers)
            time.sleep(0.2)
            if what != "runs":
                slurm.start_slurmd()
            now = records(folder)
            good = all(now.get(i) == seen[i] for i in seen)
            if kill < 3 or not good:
                check(f"Slurm, {what} killed: {len(now)} items done stay as they are", good)
            seen = now
        print(f"   kills: {killed}")
        slurm.wait_for_jobs()
        for _ in range(2):  # what was killed may be killed by slurmd's return once more
            batch(a.program, "retry", folder, "--code", "137")
            slurm.submit(folder / "array.sbatch")
            slurm.wait_for_jobs()
        print(f"   {time.time() - begin:.1f} s in all")
        check("Slurm: nothing is done twice", all(records(folder)[i] == seen[i] for i in seen))
        check("Slurm: the same bytes, the same failures", results(folder) == reference,
              f"{status(a.program, folder)}")
        before = len(list((folder / "logs").iterdir()))
        said = batch(a.program, "retry", folder, "--code", "4").stderr
        array = said.split("--array=")[1].split()[0]
        slurm.submit(f"--array={array}", folder / "array.sbatch")
        slurm.wait_for_jobs()
        check(f"Slurm: only tasks {array} are submitted again, {before} logs",
              status(a.program, folder)["to_retry"] == 0)


def by_snakemake(a, reference, check, numbers):
    if not shutil.which("snakemake"):
        print("skipped Snakemake: no snakemake (package snakemake)")
        return
    folder = a.work / "snakemake"
    plan(a.program, folder, a.work / "shapes", 10)
    words = ["snakemake", "-s", folder / "Snakefile", "--cores", "2", "--keep-going", "--quiet",
             "all", "--nolock"]
    environment = dict(os.environ, HOME=str(a.work), XDG_CACHE_HOME=str(a.work / "cache"))
    seen = {}
    for kill in range(a.kills):
        run = subprocess.Popen(words, env=environment, cwd=folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
        wait_for_items(folder, len(seen) + numbers.randint(2, 12), run)
        if numbers.random() >= 0.5:
            kill_some(steps_of("."), numbers)
        elif run.poll() is None:  # not waited for, so the group is there
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        now = records(folder)
        check(f"Snakemake, kill {kill}: {len(now)} items done stay as they are",
              all(now.get(i) == seen[i] for i in seen))
        seen = now
    batch(a.program, "retry", folder, "--code", "137")
    end = subprocess.run([*words, "--rerun-incomplete"], env=environment, cwd=folder,
                         capture_output=True, text=True, check=False)
    check("Snakemake ends with 0", end.returncode == 0, end.stderr[-2000:])
    check("Snakemake: nothing is done twice", all(records(folder)[i] == seen[i] for i in seen))
    check("Snakemake: the same bytes, the same failures", results(folder) == reference,
          f"{status(a.program, folder)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--items", type=int, default=60)
    parser.add_argument("--triangles", type=int, default=2000)
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    a = parser.parse_args()
    a.work = a.work.resolve()
    a.program = str(pathlib.Path(a.program).resolve())
    shutil.rmtree(a.work, ignore_errors=True)
    a.work.mkdir(parents=True)
    make = HERE.parent.parent / "campaign" / "make_shapes.py"
    subprocess.run([sys.executable, make, a.work / "shapes", "--count", str(a.items), "--bad", str(BAD),
                    "--triangles", str(a.triangles), "--seed", str(a.seed)], check=True)
    (a.work / "shapes" / "bad.tsv").rename(a.work / "bad.tsv")
    check, numbers = Checks(), random.Random(a.seed)
    plan(a.program, a.work / "alone", a.work / "shapes", 7)
    batch(a.program, "run", a.work / "alone", "--threads", 2)
    reference = results(a.work / "alone")
    check("alone: all but the bad ones are certified",
          len(reference[0]) == a.items - BAD and len(reference[1]) == BAD)
    by_slurm(a, reference, check, numbers)
    by_snakemake(a, reference, check, numbers)
    return 1 if check.bad else 0


if __name__ == "__main__":
    sys.exit(main())
