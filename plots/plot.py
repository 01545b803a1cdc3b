"""Draw the figures of a pairsum summary. Try: python3 plots/plot.py --help"""
import argparse
import importlib
import os
import sys

import figures
import summary as summaries

FIGURES = (*figures.FIGURES, *figures.STRATEGIES)
FORMATS = ("svg", "png")

_HELP = """\
Draw the figures of a summary that `pairsum report` made. Each figure is written as SVG and PNG.

  ladder             time per interacting pair, every backend at its best M
  speedup            speedup over the backend's own 1 thread, against threads
  efficiency         that speedup divided by the threads
  algorithm_speedup  how many times faster one algorithm is than another, per runtime
  m_comparison       summation time, distance tests, collisions and cells against M
  phase_split        where the time of a step goes, one bar per measured point
  barrier_wait       busy and waiting time of each thread
  roofline           achieved flops under the measured bandwidth and peak
  size_scaling       summation time against the number of particles
  granularity        summation time against the chunk, per schedule
  compilers          the same backend built by several compilers
  self_test          what the harness measured of known differences
  strategy_ladder    every way to keep threads apart against the gather
  strategy_threads   the same over threads
  strategy_worlds    the same from world to world
"""
_MORE = """\
Nothing is computed here: what is drawn stands in the summary. A figure without data is skipped
and the line says what is missing. Exit code: 0, or 2 with one line on stderr.

example: /usr/bin/python3 plots/plot.py summary.json --out figures
"""


def main(arguments=None):
    """Run the program; return its exit code."""
    options = _parser().parse_args(arguments)
    try:
        _run(options)
    except summaries.SummaryError as problem:
        print(f"plot.py: {' '.join(str(problem).split())}", file=sys.stderr)
        return 2
    return 0


def _parser():
    parser = argparse.ArgumentParser(prog="plot.py", description=_HELP, epilog=_MORE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("summary", metavar="SUMMARY.json", help="the summary to draw")
    parser.add_argument("--out", metavar="DIR", default=".",
                        help="folder for the figures, made if missing (default: here)")
    parser.add_argument("--only", metavar="NAME", action="append", choices=FIGURES,
                        help="draw only this figure; may be given several times")
    return parser


def _run(options):
    data = summaries.load(options.summary)
    modules = _modules(options.only or FIGURES)
    try:
        os.makedirs(options.out, exist_ok=True)
    except OSError as problem:
        raise summaries.SummaryError(f"cannot make the folder {options.out}: "
                                     f"{problem.strerror}") from None
    for note in summaries.doubles(data):
        print(f"note: {note}")
    for module in modules:
        try:
            figure = module.draw(data)
        except summaries.NoData as missing:
            print(f"{module.NAME}: skipped, {missing}")
            continue
        print(f"{module.NAME}: {', '.join(write(figure, module.NAME, options.out))}", flush=True)


def _modules(names):
    try:
        importlib.import_module("style").apply()
        return [importlib.import_module(name) for name in names]
    except ImportError as problem:
        raise summaries.SummaryError(f"needs matplotlib and numpy for {sys.executable}: {problem} "
                                     "(Debian: python3-matplotlib, python3-numpy)") from None


def write(figure, name, folder):
    """Write a figure in all formats; a file appears whole or not at all. Return the paths."""
    paths = []
    for kind in FORMATS:
        path = os.path.join(folder, f"{name}.{kind}")
        unfinished = os.path.join(folder, f".{name}.{kind}.{os.getpid()}")
        metadata = {"Date": None} if kind == "svg" else None
        try:
            figure.savefig(unfinished, format=kind, metadata=metadata)
            os.replace(unfinished, path)
        except OSError as problem:
            raise summaries.SummaryError(f"cannot write {path}: {problem.strerror}") from None
        finally:
            if os.path.exists(unfinished):
                os.remove(unfinished)
        paths.append(path)
    return paths


if __name__ == "__main__":
    sys.exit(main())
