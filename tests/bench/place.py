"""Placement on many maps: both bounds, the processor's time, and the check of each proof.

place.py SIGHTLINE FILE... [--limit SECONDS] [-- OPTION...]

Each FILE is a map, or FILE:LEVEL. OPTION... go to `sightline place` as they are. One process runs at
a time. After --limit seconds of the processor (default 60) it is interrupted, and gives the best set
and both bounds. Its proof goes through `sightline place --verify`. Prints a table with tabs between:
  name, lower, upper, seconds, memory   of `place`; memory is the peak in MiB
  verify, verify_seconds                "yes" where the proof holds and proves these bounds; else the
                                        message
Exit status: 0, or 1 where a proof does not hold.
"""
import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

COLUMNS = ["name", "lower", "upper", "seconds", "memory", "verify", "verify_seconds"]


def arguments():
    words, options = sys.argv[1:], []
    if "--" in words:
        at = words.index("--")
        words, options = words[:at], words[at + 1:]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("files", nargs="+")
    parser.add_argument("--limit", type=float, default=60, help="seconds of the processor")
    parsed = parser.parse_args(words)
    return parsed, options


def processor_seconds(pid):
    """Of a running process; the field is behind its name, which is in brackets."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def interrupt_late(pid, limit, ended):
    while not ended.wait(0.05):
        try:
            if processor_seconds(pid) > limit:
                os.kill(pid, signal.SIGINT)
                return
        except (FileNotFoundError, ProcessLookupError):
            return


def run(command, limit):
    """Exit status, what it printed, its last message, and what it took."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as messages:
        process = subprocess.Popen(command, stdout=out, stderr=messages)
        ended = threading.Event()
        watch = threading.Thread(target=interrupt_late, args=(process.pid, limit, ended))
        watch.start()
        _, status, used = os.wait4(process.pid, 0)
        ended.set()
        watch.join()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        messages.seek(0)
        lines = messages.read().strip().splitlines()
        return process.returncode, out.read(), lines[-1] if lines else "", used


def measure(program, name, limit, options, folder):
    path, colon, level = name.rpartition(":")
    source = [path, "--map", level] if colon and not os.path.exists(name) else [name]
    proof = pathlib.Path(folder, "proof.json")
    proof.unlink(missing_ok=True)
    command = [program, "place", *source, *options, "--json"]
    status, out, message, used = run([*command, "--proof", proof], limit)
    row = dict.fromkeys(COLUMNS, "")
    row |= {"name": name, "seconds": f"{used.ru_utime + used.ru_stime:.3f}",
            "memory": used.ru_maxrss // 1024}
    if not out:
        return row | {"verify": message or f"exit status {status}"}
    found = json.loads(out)
    row |= {"lower": found["lower"], "upper": found["upper"]}
    if proof.exists():
        status, out, message, used = run([*command, "--verify", proof], 600)
        proven = json.loads(out) if out else {}
        same = all(proven.get(key) == found[key] for key in ("lower", "upper"))
        row |= {"verify": "yes" if status == 0 and same else message or out or f"exit status {status}",
                "verify_seconds": f"{used.ru_utime + used.ru_stime:.3f}"}
    return row


def main():
    parsed, options = arguments()
    # A shell's background jobs ignore interrupts, and so would their children.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    print("\t".join(COLUMNS), flush=True)
    held = True
    with tempfile.TemporaryDirectory() as folder:
        for name in parsed.files:
            row = measure(parsed.sightline, name, parsed.limit, options, folder)
            held &= row["verify"] in ("", "yes")
            print("\t".join(" ".join(str(row[key]).split()) for key in COLUMNS), flush=True)
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
