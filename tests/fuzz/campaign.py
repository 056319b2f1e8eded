"""Campaign: many trials in a process of its own, which is ended where one takes too long or too much memory.

python tests/fuzz/campaign.py 10000 [FIRST_SEED]    prints how many came to what, and each fault with its seed
"""

import multiprocessing
import resource
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

PATIENCE = 20  # s of computing
WAITING = 200.0  # s that a trial may take on a machine that is busy with others
MEMORY = 8 << 30  # bytes of address space


def verdicts(seeds: Iterable[int]) -> Iterator[tuple[int, tuple[str, str, str]]]:
    """Each seed with its verdict: the subject, a word and some words more."""
    worker = None
    for seed in seeds:
        worker = worker or _Worker()
        verdict = worker.ask(seed)
        if verdict[1] in ("hang", "crash"):
            worker = worker.end()
        yield seed, verdict
    if worker:
        worker.end()


class _Worker:
    """A process that does trials."""

    def __init__(self):
        context = multiprocessing.get_context("spawn")
        self.connection, other = context.Pipe()
        self.process = context.Process(target=_work, args=(other,), daemon=True)
        self.process.start()
        other.close()  # so that the end of the process is told
        self.connection.recv()  # all is imported

    def ask(self, seed: int) -> tuple[str, str, str]:
        """What came of `seed`."""
        try:
            self.connection.send(seed)
            return self.connection.recv() if self.connection.poll(WAITING) else ("", "hang", "waits")
        except (EOFError, OSError):
            self.process.join()
            is_hang = self.process.exitcode == -signal.SIGXCPU
            return "", "hang" if is_hang else "crash", f"exit code {self.process.exitcode}"

    def end(self) -> None:
        """Kill it."""
        self.process.kill()
        self.process.join()


def _work(connection) -> None:
    import trial

    trial.compiled()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    connection.send("ready")
    while True:
        seed = connection.recv()
        used = resource.getrusage(resource.RUSAGE_SELF)
        resource.setrlimit(resource.RLIMIT_CPU, (int(used.ru_utime + used.ru_stime) + PATIENCE, -1))
        with tempfile.TemporaryDirectory() as folder:
            connection.send(tuple(trial.trial(seed, Path(folder))))


if __name__ == "__main__":
    count, first = (int(each) for each in (*sys.argv[1:], "0")[:2])
    counts = Counter()
    for seed, (subject, word, detail) in verdicts(range(first, first + count)):
        counts[word] += 1
        if word not in ("refused", "read", "ran"):
            print(seed, subject, word, detail, sep=" | ", flush=True)
    print(dict(counts))
