"""Runs the processes, and measures each from outside."""

import csv
import os
import sys
import time

FIELDS = ("round", "case", "method", "failed", "iterations", "read_s", "segment_s", "wall_s", "cpu_s", "memory_mb")


def output(results, case, method, end):
    return os.path.join(results, case.name, method.key + end)


def run(program, case, method, results):
    """One process: what it prints, its seconds from start to end, its processor seconds."""
    os.makedirs(os.path.join(results, case.name), exist_ok=True)
    outputs = {option: output(results, case, method, end)
               for option, end in (("--labels", ".mha"), ("--surface", ".vtp"), ("--convergence", ".csv"))}
    command = [program, method.key, case.image, "--seed", *map(str, case.seed), "--radius", str(case.radius),
               *(argument for option in outputs.items() for argument in option)]
    for path in outputs.values():  # of an earlier round, of which nothing is left to be said
        if os.path.exists(path):
            os.remove(path)
    reading, writing = os.pipe()
    begin = time.perf_counter()
    child = os.posix_spawn(program, command, os.environ,
                           file_actions=[(os.POSIX_SPAWN_DUP2, writing, 1), (os.POSIX_SPAWN_CLOSE, reading)])
    os.close(writing)
    with os.fdopen(reading) as pipe:
        printed = pipe.read().split()
    _, status, usage = os.wait4(child, 0)
    wall = time.perf_counter() - begin
    if os.WIFSIGNALED(status):
        raise SystemExit(f"{' '.join(command)} ended by signal {os.WTERMSIG(status)}")
    code = os.waitstatus_to_exitcode(status)
    if code not in (0, 1):  # 1: the method found nothing, which counts as its result
        raise SystemExit(f"{' '.join(command)} ended with {code}")
    failed = code == 1
    iterations, read, segment, memory = ["nan"] * 4 if failed else printed
    return {"case": case.name, "method": method.key, "failed": int(failed), "iterations": iterations, "read_s": read,
            "segment_s": segment, "wall_s": f"{wall:.3f}", "cpu_s": f"{usage.ru_utime + usage.ru_stime:.3f}",
            "memory_mb": memory}


def run_all(options, cases, methods):
    program = os.path.join(options.build, "bin", "RunMethod")
    path = os.path.join(options.results, "runs.csv")
    resumed = options.resume and os.path.exists(path)
    done = {(record["round"], record["case"], record["method"]) for record in read_runs(options.results)} \
        if resumed else set()
    with open(path, "a" if resumed else "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, FIELDS)
        if not resumed:
            table.writeheader()
        for number in range(1, options.rounds + 1):
            for case in cases:
                for method in methods:
                    if (str(number), case.name, method.key) not in done:
                        measured = run(program, case, method, options.results)
                        table.writerow({"round": number, **measured})
                        file.flush()
                print(f"round {number} of {options.rounds}: {case.name}", file=sys.stderr)


def read_runs(results):
    with open(os.path.join(results, "runs.csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))
