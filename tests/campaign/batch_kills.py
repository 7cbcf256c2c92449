#!/usr/bin/env python3
"""Kills batches at random moments, and looks whether anything is lost, half or done twice.

  batch_kills.py PROGRAM --kills 1000 --items 600 --seed 1 --work FOLDER

Each time a run is begun and killed after a random while (SIGKILL): an item's process, the runner, or
everything at once as a power cut does. In between, every folder of results must be whole: a record
that is one, and the files that it names with their sizes. A record that was there once must stay as
it is, to the byte: else the item was done twice. When all items are done, another plan begins. At
the end of each plan what was killed is tried again (`retry --code 137`), and then every item must
be certified, with the bytes that a batch has that nobody killed. Ends with 1 where that fails.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent


def children_of(pid):
    try:
        text = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text()
    except OSError:
        return []
    found = [int(word) for word in text.split()]
    for child in list(found):
        found += children_of(child)
    return found


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


class Batch:
    """One plan in a folder, and all that was ever seen of it."""

    def __init__(self, program, folder, inputs, steps):
        self.program, self.folder = program, folder
        self.records = {}
        subprocess.run([program, "batch", "plan", inputs, "-o", folder, "--chunk", "50", "--", *steps],
                       check=True, stderr=subprocess.DEVNULL)
        self.ids = [line.split("\t")[0] for line in self.manifest().splitlines()
                    if not line.startswith("#")][1:]

    def manifest(self):
        name = (self.folder / "plan").read_text().strip()
        return (self.folder / f"plan-{name}.tsv").read_text()

    def call(self, *words):
        return subprocess.run([self.program, "batch", words[0], self.folder, *words[1:]], check=True,
                              capture_output=True, text=True)

    def start(self):
        return subprocess.Popen([self.program, "batch", "run", self.folder, "--threads", "2"],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def faults(self):
        """What must never be: told as texts."""
        for entry in os.scandir(self.folder / "results"):
            path = pathlib.Path(entry.path) / "record.json"
            try:
                text = path.read_bytes()
            except OSError:
                yield f"half: {entry.name} has no record"
                continue
            known = self.records.get(entry.name)
            if known is None:
                record = json.loads(text)
                for name, size, _ in record["files"]:
                    if (path.parent / name).stat().st_size != size:
                        yield f"half: {entry.name}/{name}"
                if record["outcome"] != "certified":
                    yield f"half: {entry.name} is {record['outcome']}"
                self.records[entry.name] = text
            elif known != text:
                yield f"done twice: {entry.name}"
        for name in self.records:
            if not (self.folder / "results" / name).is_dir():
                yield f"lost: {name}"
        for entry in os.scandir(self.folder / "failed"):
            record = json.loads(pathlib.Path(entry.path).read_bytes())
            if record["code"] != 137:
                yield f"failed: {entry.name} with {record['code']}: {record['reason']}"

    def maps(self):
        """The hash of each item's map."""
        return {i: json.loads(self.records[i])["files"][0][2] for i in self.records}

    def finish(self):
        """Runs what is left, with what was killed; yields what is wrong."""
        for _ in range(3):
            self.call("retry", "--code", "137")
            self.call("run", "--threads", "2")
        yield from self.faults()
        for i in self.ids:
            if i not in self.records:
                yield f"lost: {i}"
        if os.listdir(self.folder / "staging"):
            yield f"left: {os.listdir(self.folder / 'staging')}"


def kill_once(batch, numbers, tally):
    run = batch.start()
    target = numbers.choice(("item", "runner", "all"))
    time.sleep(numbers.random() ** 2 * 0.6)
    if run.poll() is not None:
        return False
    below = children_of(run.pid)
    if target == "item" and not below:
        target = "runner"
    if target == "item":
        kill(numbers.choice(below))
        time.sleep(numbers.random() * 0.05)
    if target == "all":
        for pid in [run.pid, *below]:
            kill(pid)
    kill(run.pid)
    run.wait()
    tally[target] = tally.get(target, 0) + 1
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--items", type=int, default=600)
    parser.add_argument("--triangles", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    a = parser.parse_args()
    shutil.rmtree(a.work, ignore_errors=True)
    a.work.mkdir(parents=True)
    subprocess.run([sys.executable, HERE / "make_shapes.py", a.work / "shapes", "--count", str(a.items),
                    "--bad", "0", "--triangles", str(a.triangles), "--seed", str(a.seed)], check=True)
    numbers = random.Random(a.seed)
    killed, plans, faults, tally = 0, 0, [], {}
    while killed < a.kills and not faults:
        steps = ["map", "--lambda", str(1 + plans)]
        reference = Batch(a.program, a.work / f"reference{plans}", a.work / "shapes", steps)
        faults += reference.finish()
        batch = Batch(a.program, a.work / f"batch{plans}", a.work / "shapes", steps)
        while killed < a.kills and not faults:
            before = killed
            killed += kill_once(batch, numbers, tally)
            faults += [f"kill {killed}, plan {plans}: {fault}" for fault in batch.faults()]
            if killed == before:
                break
        faults += batch.finish()
        if not faults and batch.maps() != reference.maps():
            faults.append(f"plan {plans}: other bytes than without kills")
        plans += 1
        if not faults:
            shutil.rmtree(batch.folder)
            shutil.rmtree(reference.folder)
        print(f"seed {a.seed}: {killed} kills {tally}, {plans} plans of {len(batch.ids)} items, "
              f"{len(faults)} faults", flush=True)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
