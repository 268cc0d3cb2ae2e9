"""Records: CSV files in bench/record, each row with the machine and the state of the repository it was made on."""

import csv
import datetime
import os
import platform
import subprocess

import environment

FOLDER = environment.ROOT / "bench" / "record"
# Processes that were running or waiting to, on average over a minute, before any of ours: times of a busy machine say little.
LOAD_BEFORE = round(os.getloadavg()[0], 2)


def machine():
    """The columns that every record starts with."""
    commit = git("rev-parse", "--short=10", "HEAD")
    # Records and pictures that earlier parts of the same run wrote do not count.
    changed = git("status", "--porcelain", "--untracked-files=no", "--", "crates", "Cargo.toml", "Cargo.lock", "bench/peers")
    return {
        "date": datetime.date.today().isoformat(),
        "commit": commit + ("+changes" if changed else ""),
        "cpu": cpu(),
        "cores": os.cpu_count(),
        "load_before": LOAD_BEFORE,
        "memory_gib": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30, 1),
        "system": f"{platform.system()} {platform.machine()}, {distribution()}",
    }


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=environment.ROOT, capture_output=True, text=True).stdout.strip()


def cpu():
    with open("/proc/cpuinfo") as lines:
        return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.processor())


def distribution():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except (AttributeError, OSError):  # Python before 3.10, or no such file
        return "unknown"


def path(name):
    """Where today's record of a kind goes."""
    return FOLDER / f"{datetime.date.today().isoformat()}-{name}.csv"


def write(to, fields, rows):
    """Writes rows, each with the columns of `machine` before those of `fields`."""
    of_machine = machine()
    to.parent.mkdir(parents=True, exist_ok=True)
    with open(to, "w", newline="") as file:
        writer = csv.DictWriter(file, [*of_machine, *fields])
        writer.writeheader()
        writer.writerows(of_machine | row for row in rows)


def read(from_):
    with open(from_, newline="") as file:
        return list(csv.DictReader(file))


def latest(name):
    """The newest record of a kind, or None. Names begin with the date."""
    return max(FOLDER.glob(f"*-{name}.csv"), default=None)


def append(to, fields, row):
    """Adds a row to a record, which is made with its first row."""
    to.parent.mkdir(parents=True, exist_ok=True)
    is_new = not to.exists()
    with open(to, "a", newline="") as file:
        writer = csv.DictWriter(file, fields)
        if is_new:
            writer.writeheader()
        writer.writerow(row)
