"""Kills the program at random moments: a file that it writes is the old one or the new one, never a half.

usage: kill_and_look.py CAMBER CASE_DIR WORK_DIR [--rounds N] [--seed S]

Every format in turn, and `curve` beside `convert`. A round puts a known old file in place, starts the program,
kills it (SIGKILL) after a random share of the time that it takes, and looks: the target holds the bytes of the
old file or of a complete run. A .cgns file has a few other bytes every time, so there the new one is any that
converts to the same .su2. With .ugrid the names (.mapbc) are a file of their own, judged in the same way; and
a new mesh never stands beside old names.
"""
import argparse
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path


def run(*command):
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL)


class Job:
    """One way of writing files, with what complete runs make."""

    def __init__(self, name, camber, work, arguments, targets):
        self.name, self.work, self.camber = name, work, camber
        self.targets = [work / t for t in targets]
        self.command = [str(camber), *map(str, arguments), '-q']
        start = time.monotonic()
        run(*self.command)
        self.seconds = time.monotonic() - start
        self.new = {t: t.read_bytes() for t in self.targets}
        self.old = {t: b'the old ' + t.name.encode() for t in self.targets}

    def verdict(self, target):
        found = target.read_bytes() if target.exists() else None
        if found == self.old[target]:
            return 'old'
        if found == self.new[target]:
            return 'new'
        if found is not None and target.suffix == '.cgns' and self.same_mesh(target):
            return 'new'
        return 'missing' if found is None else f'a half: {len(found)} of {len(self.new[target])} bytes'

    def same_mesh(self, target):
        texts = []
        for data in (target.read_bytes(), self.new[target]):
            copy, flat = self.work / 'copy.cgns', self.work / 'copy.su2'
            copy.write_bytes(data)
            if subprocess.run([str(self.camber), 'convert', str(copy), str(flat), '-q'],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0:
                return False
            texts.append(flat.read_bytes())
        return texts[0] == texts[1]

    def round(self, share):
        for target in self.targets:
            target.write_bytes(self.old[target])
        process = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(share * self.seconds)
        process.send_signal(signal.SIGKILL)
        killed = process.wait() == -signal.SIGKILL
        verdicts = [self.verdict(t) for t in self.targets]
        # What a killed run may leave are files of its own name, never the target.
        left = [f for f in self.work.glob('.*.tmp')]
        for f in left:
            os.remove(f)
        return killed, verdicts, len(left)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('camber', type=Path)
    parser.add_argument('case', type=Path)
    parser.add_argument('work', type=Path)
    parser.add_argument('--rounds', type=int, default=9)
    parser.add_argument('--seed', type=int, default=1)
    args = parser.parse_args()
    args.work.mkdir(parents=True, exist_ok=True)
    mesh, cad, curved = args.case / 'linear.msh', args.case / 'body.step', args.work / 'curved.msh'
    run(args.camber, 'curve', mesh, '-g', cad, '-o', curved, '--order', '2', '--deviation', '0.01', '-q')
    jobs = [Job('convert ' + f, args.camber, args.work,
                ['convert', curved, args.work / f, *(['--order', '1'] if 'ugrid' in f else [])],
                [f, 'u.mapbc'] if 'ugrid' in f else [f])
            for f in ('c.msh', 'c.mesh', 'c.xml', 'c.h5', 'c.cgns', 'c.su2', 'c.vtu', 'u.lb8.ugrid')]
    jobs.append(Job('curve', args.camber, args.work,
                    ['curve', mesh, '-g', cad, '-o', args.work / 'k.msh', '-o', args.work / 'k.vtu',
                     '--order', '2', '--deviation', '0.01'], ['k.msh', 'k.vtu']))
    chance = random.Random(args.seed)
    counts, bad = {}, 0
    for i in range(args.rounds):
        job = jobs[i % len(jobs)]
        killed, verdicts, left = job.round(chance.uniform(0.0, 1.1))
        for target, verdict in zip(job.targets, verdicts):
            counts[verdict.split(':')[0]] = counts.get(verdict.split(':')[0], 0) + 1
            if verdict not in ('old', 'new'):
                print(f'{job.name}: {target.name} is {verdict}')
                bad += 1
        if 'ugrid' in job.name and verdicts == ['new', 'old']:
            print(f'{job.name}: a new mesh with the old names')
            bad += 1
        counts['killed' if killed else 'finished before'] = \
            counts.get('killed' if killed else 'finished before', 0) + 1
        counts['temporaries left'] = counts.get('temporaries left', 0) + left
    print(f'{args.rounds} rounds: ' + ', '.join(f'{n} {what}' for what, n in sorted(counts.items())))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
