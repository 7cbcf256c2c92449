#!/usr/bin/env python3
"""What batches cost beside the mapping, in ratios within one run, and how long they take to look at.

  batch_figures.py PROGRAM WORK_FOLDER [--meshes 1000] [--triangles 10000] [--resume 10000]
                   [--status 100000]

The figures of docs/results.md are with --meshes 10000. CPU is that of all processes, in user and
system; the mapping's is that of `sphparam map --json`, one process a mesh, just before and after.
"""

import argparse
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "interop" / "batch"))
import one_node_slurm  # noqa: E402  (a neighbour in the tree)


def measured(words, **settings):
    """CPU and wall seconds of a command with everything it waits for."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
    subprocess.run(list(map(str, words)), check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, **settings)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.time() - begin


def plan(program, folder, inputs, chunk):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([program, "batch", "plan", inputs, "-o", folder, "--chunk", str(chunk), "--", "map"],
                   check=True, stderr=subprocess.DEVNULL)


def item_cpu(folder):
    return sum(json.loads(r.read_bytes())["cpu_seconds"] for r in folder.glob("results/*/record.json"))


def cpu_of_daemon(pid):
    """With its children that have ended."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


class Mapping:
    """The mapping alone, one process a mesh: a sample of it is timed before and after each batch, so
    that a machine that becomes slower or faster meanwhile does so for both. Each map is a new file
    that stays, as in a batch: one that is written over never reaches the disk, and costs less."""

    def __init__(self, a):
        self.a, self.maps = a, a.work / "maps"
        self.sample = sorted((a.work / "shapes").glob("*.ply"))[::max(a.meshes // 1000, 1)]
        self.before = self.seconds()

    def seconds(self):
        """Of CPU, for all meshes, after the sample."""
        shutil.rmtree(self.maps, ignore_errors=True)
        self.maps.mkdir()
        command = (f'for m; do "{self.a.program}" map "$m" -o "{self.maps}/${{m##*/}}.sph.ply" '
                   f'--json "{self.maps}/${{m##*/}}.json" --threads 1 -q; done')
        cpu, _ = measured(["sh", "-c", command, "sh", *self.sample])
        return cpu * self.a.meshes / len(self.sample)

    def about(self, measure):
        """What `measure` returns, and the seconds of CPU that the mapping takes about that time."""
        result, after = measure(), self.seconds()
        mapping, self.before = (self.before + after) / 2, after
        return result, mapping


def overheads(a):
    mapping = Mapping(a)
    print(f"mapping: {1000 * mapping.before / a.meshes:.1f} ms of CPU a mesh", flush=True)

    def tell(name, words, **settings):
        (cpu, wall), alone = mapping.about(lambda: measured(words, **settings))
        print(f"{name}: {cpu:.1f} s of CPU, {100 * (cpu / alone - 1):+.1f} % of the mapping's "
              f"{alone:.1f}, {wall:.1f} s", flush=True)
        return wall

    walls = {}
    for threads in (1, 2):
        plan(a.program, a.work / "alone", a.work / "shapes", 50)
        walls[threads] = tell(f"batch run --threads {threads}",
                              [a.program, "batch", "run", a.work / "alone", "--threads", threads])
    print(f"throughput of two threads: {walls[1] / walls[2]:.2f} × one's", flush=True)
    if shutil.which("snakemake"):
        plan(a.program, a.work / "snakemake", a.work / "shapes", 50)
        tell("Snakemake", ["snakemake", "-s", a.work / "snakemake" / "Snakefile", "--cores", "2",
                           "--quiet", "all"], cwd=a.work / "snakemake")
    if not one_node_slurm.missing():
        by_slurm(a, mapping)


def by_slurm(a, mapping):
    folder = a.work / "slurm"
    plan(a.program, folder, a.work / "shapes", 50)

    def measure():
        with one_node_slurm.OneNodeSlurm(a.work / "one-node") as slurm:
            daemons = [slurm.pid(name) for name in ("slurmd", "slurmctld", "munged")]
            before, begin = sum(map(cpu_of_daemon, daemons)), time.time()
            slurm.submit(folder / "array.sbatch")
            slurm.wait_for_jobs(36000)
            wall = time.time() - begin
            # Steps are no children of slurmd that it waits for everywhere: items are counted by records.
            return sum(map(cpu_of_daemon, daemons)) - before, item_cpu(folder), wall

    (daemons_cpu, items, wall), alone = mapping.about(measure)
    print(f"Slurm: daemons and their children {daemons_cpu:.1f} s of CPU, "
          f"{100 * daemons_cpu / alone:.1f} % of the mapping's {alone:.1f}; items {items:.1f} s; "
          f"{wall:.1f} s", flush=True)


def resume(a):
    plan(a.program, a.work / "many", a.work / "small", 50)
    measured([a.program, "batch", "run", a.work / "many"])
    for words in ([], ["--rehash"]):
        cpu, wall = measured([a.program, "batch", "run", a.work / "many", *words])
        print(f"resume of {a.resume} that are done {' '.join(words)}: {wall:.2f} s, {cpu:.2f} s of CPU",
              flush=True)


def status(a):
    """Records as a batch leaves them, made of one for as many items as are wanted."""
    folder, inputs = a.work / "hundred", a.work / "links"
    inputs.mkdir()
    one = next((a.work / "small").glob("*.ply"))
    for i in range(a.status):
        os.symlink(one, inputs / f"i{i:06}.ply")
    plan(a.program, folder, inputs, 1000)
    name = (folder / "plan").read_text().strip()
    subprocess.run([a.program, "batch", "run", folder, "--task", "1"], check=True,
                   stderr=subprocess.DEVNULL)
    lines = (folder / f"plan-{name}.tsv").read_text().splitlines()
    lines = [line.split("\t") for line in lines if not line.startswith("#")][1:]
    sample = (folder / "results" / "i000000" / "record.json").read_text()
    for item, path, _, _, options in lines[1000:]:
        result = folder / "results" / item
        result.mkdir()
        (result / "record.json").write_text(
            sample.replace(lines[0][4], options).replace("i000000", item))
    for _ in range(2):
        cpu, wall = measured([a.program, "batch", "status", folder])
        print(f"status of {a.status}: {wall:.2f} s, {cpu:.2f} s of CPU", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("work", type=pathlib.Path)
    for name, preset in (("meshes", 1000), ("triangles", 10000), ("resume", 10000), ("status", 100000)):
        parser.add_argument(f"--{name}", type=int, default=preset)
    a = parser.parse_args()
    a.program, a.work = str(pathlib.Path(a.program).resolve()), a.work.resolve()
    shutil.rmtree(a.work, ignore_errors=True)
    a.work.mkdir(parents=True)
    make = [sys.executable, HERE.parent / "campaign" / "make_shapes.py"]
    for folder, count, triangles in (("shapes", a.meshes, a.triangles),
                                     ("small", max(a.resume, 1 if a.status else 0), 100)):
        if count:
            subprocess.run([*make, a.work / folder, "--count", str(count), "--bad", "0",
                            "--triangles", str(triangles)], check=True)
    if a.meshes:
        overheads(a)
    if a.resume:
        resume(a)
    if a.status:
        status(a)
    return 0


if __name__ == "__main__":
    sys.exit(main())
