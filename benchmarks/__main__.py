"""``python -m benchmarks [NAME ...] [--size SIZE] [--json] [--history]``."""

import argparse
import json
import os
import pkgutil
import platform
import subprocess
from collections.abc import Iterator, Mapping
from importlib import import_module
from pathlib import Path

import benchmarks

HISTORY = Path(__file__).with_name("history.jsonl")

Result = dict[str, object]


def main() -> None:
    """Runs the named benchmarks, by default all, and prints their results."""
    names = sorted(
        module.name for module in pkgutil.iter_modules(benchmarks.__path__) if not module.name.startswith("_")
    )
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Measure how fast the realizer is.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"what to measure (default all): {', '.join(names)}")
    parser.add_argument("--size", type=float, help="how much to measure, in the unit of the benchmark's `measure`")
    parser.add_argument("--json", action="store_true", help="print one JSON object a benchmark, on a line of its own")
    parser.add_argument("--history", action="store_true", help=f"add the results to {HISTORY.name}")
    options = parser.parse_args()
    if unknown := sorted(set(options.names).difference(names)):
        parser.error(f"no benchmark {', '.join(unknown)}; there are {', '.join(names)}")
    for name in options.names or names:
        run(name, options.size, as_json=options.json, keep=options.history)


def run(name: str, size: float | None, *, as_json: bool, keep: bool) -> None:
    """Runs one benchmark, by default in its own size, prints its result, and optionally adds it to the history."""
    module = import_module(f"benchmarks.{name}")
    measured = module.measure() if size is None else module.measure(int(size) if size.is_integer() else size)
    result: Result = {**measured, "machine": machine(), "commit": commit()}
    if as_json:
        print(json.dumps(result), flush=True)
    else:
        print(table(name, result, last(name), module.AIMS), flush=True)
    if keep:
        with HISTORY.open("a", encoding="utf-8") as history:
            history.write(json.dumps({"benchmark": name, **result}) + "\n")


def machine() -> Result:
    """A description of this machine."""
    return {
        "cpu": _cpu(),
        "cores": os.cpu_count(),
        "load": round(os.getloadavg()[0], 2),
        "python": platform.python_version(),
    }


def commit() -> str | None:
    """The commit of the repository; None outside of one."""
    command = ["git", "describe", "--always", "--dirty", "--exclude", "*"]
    try:
        found = subprocess.run(command, cwd=HISTORY.parent, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return found.stdout.strip()


def last(name: str) -> Result:
    """The last result of a benchmark in the history; empty if there is none."""
    lines = HISTORY.read_text(encoding="utf-8").splitlines() if HISTORY.exists() else []
    results = (json.loads(line) for line in reversed(lines))
    return next((result for result in results if result["benchmark"] == name), {})


def table(name: str, result: Result, before: Result, aims: Mapping[str, float]) -> str:
    """The numbers of a result as text, each with its aim and its ratio to the previous result."""
    old = dict(_numbers(before))
    rows = [f"{name}, commit {result['commit']}, load {_machine(result)['load']}, {_machine(result)['cpu']}"]
    for key, value in _numbers(result):
        aim = f"aim {aims[key]:g}" if key in aims else ""
        ratio = f"x {value / was:.2f}" if value is not None and (was := old.get(key)) else ""
        rows.append(f"  {key:32}{'-' if value is None else format(value, '.4g'):>12}  {aim:12}{ratio}".rstrip())
    return "\n".join(rows)


def _numbers(result: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, float | None]]:
    for key, value in result.items():
        if isinstance(value, Mapping) and key != "machine":
            yield from _numbers(value, f"{prefix}{key}.")
        elif value is None or isinstance(value, int | float):
            yield prefix + key, value


def _machine(result: Result) -> Mapping[str, object]:
    found = result["machine"]
    return found if isinstance(found, Mapping) else {}


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())


if __name__ == "__main__":
    main()
