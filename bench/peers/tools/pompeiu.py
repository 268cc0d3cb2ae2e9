"""This project's program, once with all threads and once with one."""

TITLE = "pompeiu"
PROGRAM = "pompeiu"
KIND = "enclosure"
