"""The command that pip installs, in forks of one process that has loaded it: loading it anew takes most of a short run.

  from forked_command import run
  run(PROGRAM, arguments)       as subprocess.run() would give it, without an input

  python forked_command.py      what is forked: by the command's interpreter
"""

import atexit
import contextlib
import functools
import json
import os
import signal
import subprocess
import sys
import tempfile

# Of a run; FLIPFREE_SLOWNESS is how much longer things take than in the build that users have.
SECONDS = round(120 * float(os.environ.get("FLIPFREE_SLOWNESS", "1")))


@functools.lru_cache(maxsize=None)
def _loaded(program):
    python = os.path.join(os.path.dirname(program), "python")
    process = subprocess.Popen([python, os.path.abspath(__file__)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    atexit.register(process.wait)
    atexit.register(process.stdin.close)
    return process


def run(program, arguments):
    process = _loaded(program)
    try:
        print(json.dumps({"folder": os.getcwd(), "arguments": arguments}), file=process.stdin, flush=True)
        answer = process.stdout.readline()
    except BrokenPipeError:
        answer = ""
    if not answer:
        _loaded.cache_clear()
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
        raise ChildProcessError(f"what is forked for {program} has ended with status {process.wait()}")
    return subprocess.CompletedProcess([program, *arguments], *json.loads(answer))


def _fork(main, request):
    """Status, output and error text."""
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        child = os.fork()
        if child == 0:
            signal.alarm(SECONDS)
            for number, stream in enumerate((os.open(os.devnull, os.O_RDONLY), output.fileno(), errors.fileno())):
                os.dup2(stream, number)
            os.chdir(request["folder"])
            status = main(request["arguments"])
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (output, errors):
            file.seek(0)
            texts.append(file.read().decode())
    return [status, *texts]


def _serve():
    import numpy  # pylint: disable=unused-import
    from flipfree import _subcommands  # pylint: disable=unused-import
    from flipfree._command import main

    for line in sys.stdin:
        print(json.dumps(_fork(main, json.loads(line))), flush=True)


if __name__ == "__main__":
    _serve()
