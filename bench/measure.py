#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a command and writes what it cost: wall and CPU seconds, peak memory, exit code.

  bench/measure.py OUT.json COMMAND...

CPU time is of the command and all that it waited for; the peak is that of its largest process.
Stucco resets its peak at the start of every stage: of a run of several stages this is the last
one's, and key_figures.py tells those of all.
"""
import json
import os
import pathlib
import signal
import sys
import time


def measure(command, output=None):
    """`output` is a file descriptor for what the command prints; none: where ours goes."""
    actions = [] if output is None else [(os.POSIX_SPAWN_DUP2, output, 1),
                                         (os.POSIX_SPAWN_DUP2, output, 2)]
    start = time.monotonic()
    pid = os.posix_spawnp(command[0], command, os.environ, file_actions=actions)
    def stop(*_):
        os.kill(pid, signal.SIGTERM)
        sys.exit(128 + signal.SIGTERM)

    before = signal.signal(signal.SIGTERM, stop)
    try:
        _, status, usage = os.wait4(pid, 0)
    except BaseException:  # ours was stopped, and the command with it: Ctrl-C goes to both
        os.wait4(pid, 0)
        raise
    finally:
        signal.signal(signal.SIGTERM, before)
    return {"exit_code": os.waitstatus_to_exitcode(status),
            "wall_s": round(time.monotonic() - start, 2),
            "cpu_s": round(usage.ru_utime + usage.ru_stime, 2),
            "peak_memory_mb": round(usage.ru_maxrss / 1024, 1)}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    result = measure(sys.argv[2:])
    pathlib.Path(sys.argv[1]).write_text(json.dumps(result) + "\n")
    sys.exit(result["exit_code"] if result["exit_code"] >= 0 else 128 - result["exit_code"])


if __name__ == "__main__":
    main()
