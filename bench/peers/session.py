"""One tool on one pair: a process that holds both meshes and answers each time it is asked.

Every session has `ask()`, which returns an answer (see worker.py) or raises `NoAnswer`, and `close()`. A tool that takes
too long, or too much memory, or dies, is ended; that is its result, and the others go on.
"""

import json
import os
import pathlib
import resource
import selectors
import subprocess
import tempfile
import time

import environment

HERE = pathlib.Path(__file__).resolve().parent


class NoAnswer(Exception):
    """Why there is none: `status` is timeout, memory, crashed or refused; the message has the details."""

    def __init__(self, status, detail=""):
        super().__init__(detail)
        self.status = status


class Worker:
    """A peer in its own process, which loads the meshes once."""

    def __init__(self, command, limits):
        self.limits = limits
        self.errors = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True, bufsize=1, cwd=HERE,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limits.memory, limits.memory)))
        self.version = None

    def ready(self):
        """Waits until the meshes are loaded."""
        if self.version is None:
            self.version = self.answer(self.limits.loading)["version"]

    def ask(self):
        self.ready()
        try:
            self.process.stdin.write("go\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # the answer says why
        return self.answer(self.limits.seconds)

    def answer(self, seconds):
        """The next line that is an object; tools print lines of their own."""
        end = time.monotonic() + seconds
        with selectors.DefaultSelector() as selector:
            selector.register(self.process.stdout, selectors.EVENT_READ)
            while (left := end - time.monotonic()) > 0 and selector.select(left):
                line = self.process.stdout.readline()
                if line.startswith("{"):
                    return json.loads(line)
                if not line:
                    raise self.death()
        self.close()
        raise NoAnswer("timeout", f"more than {seconds:g} s")

    def death(self):
        """Why the process ended."""
        code = self.process.wait()
        self.errors.seek(0)
        said = environment.last_line(self.errors.read())
        if any(word in said for word in ("MemoryError", "bad_alloc", "Cannot allocate", "bad allocation")):
            return NoAnswer("memory", f"more than {self.limits.memory / 2**30:g} GiB")
        return NoAnswer("crashed", f"signal {-code}") if code < 0 else NoAnswer("refused", said)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self.errors.close()


class Pompeiu:
    """Our own program: a new process each time, which reads the files, unlike a worker; its own clock leaves that out."""

    def __init__(self, binary, pair, tolerance, threads, limits):
        self.binary, self.threads, self.limits = binary, threads, limits
        self.command = [
            binary, "distance", *pair, "--direction", "a-to-b", "--json", "--quiet", "--tolerance", repr(tolerance),
            "--tolerance-kind", "absolute", "--threads", str(threads),
        ]
        self.start_mib = measured([binary, "--version"])[1]
        self.version = subprocess.run([binary, "--version"], capture_output=True, text=True).stdout.split()[-1]

    def ready(self):
        pass

    def ask(self):
        out, peak, cpu = measured(self.command, self.limits.seconds)
        answer = json.loads(out)["report"]
        return {
            "lower": answer["a_to_b"]["lower"], "upper": answer["a_to_b"]["upper"],
            "wall_ms": answer["timing_ms"]["build"] + answer["timing_ms"]["search"], "cpu_ms": cpu,
            "peak_mib": peak, "memory_over_start_mib": peak - self.start_mib,
        }

    def close(self):
        pass


def measured(command, seconds=None):
    """Runs a command; its output, peak memory in MiB and CPU time in ms by the operating system's account."""
    process = subprocess.Popen([environment.peak(), *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               start_new_session=True)
    try:
        out, errors = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.communicate()
        raise NoAnswer("timeout", f"more than {seconds:g} s") from None
    *said, account = errors.splitlines()
    kib, cpu_ms = account.split()
    # 3: the tolerance was not reached; the answer stands.
    if process.returncode not in (0, 3):
        raise NoAnswer("refused", said[-1] if said else f"exit code {process.returncode}")
    return out, int(kib) / 1024, float(cpu_ms)
