"""The programs: `python3 -m pairsum_results report FILE...`, `compare A B`, `history` and `convert IN... OUT.hdf`."""
import argparse
import json
import os
import pathlib
import signal
import sys
import warnings
from typing import Callable

from .rows import PHASES, ResultsError
from .words import hint, one_line, unknown

_HISTORY_PHASES = [name.removesuffix("_s") for name in (*PHASES, "evaluation_s")]


def _say(text: str) -> None:
    """Prints to stdout at once. Raises ResultsError if that is lost, as on a full disk."""
    try:
        print(text, flush=True)
    except OSError as problem:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # which takes what is left at the end
        raise ResultsError(f"its output is lost: {problem.strerror}") from None


def _complain(what: str) -> None:
    """Prints a line to stderr; that it may be lost changes nothing."""
    try:
        print(f"pairsum: {what}", file=sys.stderr, flush=True)
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


class _Parser(argparse.ArgumentParser):
    def print_help(self, file=None):
        _say(self.format_help().rstrip("\n"))

    def error(self, message: str):
        """One line, as the rest of pairsum has it."""
        _complain(f"{one_line(message)} (see {self.prog} --help)")
        self.exit(2)

    def refuse(self, word: str):
        """Says of a word that nothing takes which option was meant."""
        name = word.partition("=")[0]
        near = hint(name, [known for action in self._actions for known in action.option_strings])
        what = f"unknown option {name} of {self.prog}" if word.startswith("-") else f'{self.prog} does not take "{word}"'
        _complain(f"{one_line(what)};{near} {self.prog} --help lists its options")
        self.exit(2)


def main(arguments: list[str] | None = None) -> int:
    """Run a program; return its exit code: 0, 1 if the history found something slower, 2 with one line on stderr (also
    if its output is lost), 130 after SIGINT."""
    parser = _Parser(prog="pairsum")
    programs = parser.add_subparsers(required=True, metavar="PROGRAM", dest="program")
    _report_program(programs)
    _compare_program(programs)
    _history_program(programs)
    _convert_program(programs)

    def run() -> int:
        options, rest = parser.parse_known_args(arguments)
        if options.program == "convert":  # whose files may stand behind an option, too
            options.files += [word for word in rest if not word.startswith("-")]
            rest = [word for word in rest if word.startswith("-")]
        if rest:
            programs.choices[options.program].refuse(rest[0])
        return options.run(options) or 0
    return _reported(run)


def _reported(run: Callable[[], int]) -> int:
    """The exit code of `run`; what it raises is a line."""
    try:
        return run()
    except ResultsError as problem:
        _complain(one_line(str(problem)))
        return 2
    except OSError as problem:
        _complain(one_line(f"{problem.filename}: {problem.strerror}"))
        return 2
    except MemoryError:
        _complain("not enough memory")
        return 2
    except KeyboardInterrupt:
        return 130


def _report_program(programs) -> None:
    program = programs.add_parser(
        "report", help="tables, figures and a page from rows files", description="Tables (text, Markdown, CSV), "
        "summary.json, figures and one page, report.html, from rows files. Rows that failed their verification never "
        "enter a table, nor do rounds that were cut.")
    program.add_argument("inputs", nargs="+", metavar="FILE",
                         help="rows files, or folders of them, with the folders below")
    program.add_argument("--out", metavar="DIR", type=pathlib.Path,
                         help="folder for the files (default: named like the rows file, beside it)")
    program.add_argument("--tables", action="store_true",
                         help="print the tables; write them, CSV and summary.json alone: no figures, no page")
    program.add_argument("--beside", metavar="FILE", nargs="+", default=[],
                         help="rows files of other machines, each beside the first on the page")
    program.add_argument("--paper", action="store_true",
                         help="figures for print (PDF, 84 mm wide), LaTeX tables and a paragraph of methods, in paper/")
    program.add_argument("--allow-mixed", action="store_true",
                         help="compare rows of different machines or builds nevertheless")
    program.set_defaults(run=_report)


def _report(options: argparse.Namespace) -> None:
    # pandas and scipy take a moment, which --help need not wait for.
    from . import load, report, summary
    from .answers import said_of

    first = pathlib.Path(options.inputs[0])
    if not options.out and first.is_file() and first.suffix != ".jsonl":
        raise ResultsError(f"{first} does not end in .jsonl, so --out DIR should name the folder for the files")
    folder = options.out or (first if first.is_dir() else first.with_suffix(""))
    said = report(load(options.inputs, options.allow_mixed))
    others = [report(load([path], options.allow_mixed)) for path in options.beside]
    tables = summary.write(said, folder)
    _say("\n".join(said_of(said.answer)))
    if options.tables:
        _say("\n" + tables.rstrip("\n"))
    shown = one_line(str(folder))
    _say(f"tables:  {shown}/tables.txt, tables.md, csv/, rounds.csv, summary.json")
    if options.tables:
        return
    from . import page, paper

    if options.paper:
        paper.write(said, folder / "paper")
        _say(f"paper:   {shown}/paper")
    _say(f"figures: {len(page.write([said, *others], folder))} files, {shown}/*.png")
    _say(f"page:    {shown}/report.html")


def _compare_program(programs) -> None:
    program = programs.add_parser(
        "compare", help="is B faster than A, by how much, and how sure is that?", description="Is B faster than A, by "
        "how much, and how sure is that? A and B are two backends, with words like precision=mixed for what else may "
        "differ, two rows files (or folders), or two git revisions that rows were measured with.",
        epilog='example: pairsum compare "symmetric_omp precision=double" "tiles_omp precision=mixed" --in '
        'results/vector')
    program.add_argument("a", metavar="A", help="the base")
    program.add_argument("b", metavar="B", help="what is compared with it")
    program.add_argument("--in", dest="inputs", nargs="+", metavar="FILE", default=["results"],
                         help="rows files or folders that hold the backends or revisions (default: results)")
    program.add_argument("--phase", default="sum",
                         help=f"{', '.join(phase.removesuffix('_s') for phase in PHASES)} (default: sum)")
    program.add_argument("--allow-mixed", action="store_true",
                         help="compare different machines, or builds with uncommitted changes, nevertheless")
    program.add_argument("--json", action="store_true", help="the comparison as one JSON document")
    program.set_defaults(run=_compare)


def _compare(options: argparse.Namespace) -> None:
    from .sides import compare_sides

    found = compare_sides(options.a, options.b, options.inputs, options.phase, options.allow_mixed)
    _say(json.dumps(found.document(), indent=1, allow_nan=False) if options.json else found.text().rstrip("\n"))


def _history_program(programs) -> None:
    program = programs.add_parser(
        "history", help="did a revision make something slower?", description="Did a revision make something slower? "
        "Every point of the rows against the same point of the revision before it, on the same machine and with the "
        "machine's own pace taken out; and, if there are several machines, against the others. Exit code 1 if the "
        "newest revision of a machine is slower anywhere (95 % confidence over all points), 0 if not.")
    program.add_argument("inputs", nargs="*", metavar="FILE", default=["results"],
                         help="rows files, or folders of them, with the folders below (default: results)")
    program.add_argument("--phase", default="sum", help=f"{', '.join(_HISTORY_PHASES)} (default: sum)")
    program.add_argument("--out", metavar="DIR", type=pathlib.Path,
                         help="folder for history.html, history.csv and machines.csv (default: history in the first "
                         "folder of rows)")
    program.set_defaults(run=_history)


def _history(options: argparse.Namespace) -> int:
    from . import history_report
    from .history import load_history

    if options.phase not in _HISTORY_PHASES:
        raise ResultsError(unknown("phase", options.phase, _HISTORY_PHASES))
    first = pathlib.Path(options.inputs[0])
    folder = options.out or (first if first.is_dir() else first.parent) / "history"
    found = load_history(options.inputs, f"{options.phase}_s")
    _say(history_report.write(found, folder).rstrip("\n"))
    _say(f"page: {one_line(str(folder / 'history.html'))}")
    return 1 if len(found.slower) else 0


def _convert_program(programs) -> None:
    program = programs.add_parser(
        "convert", help="particle files of other programs to one .hdf", usage="pairsum convert [options] IN... OUT.hdf",
        description="Reads particles of other programs and writes one .hdf, which pairsum and ParaView read: VTK "
        "(.vtp, .vtu, .pvtp, .pvtu, .vtk), GROMACS .gro, LAMMPS dumps, GSD, H5MD, extended XYZ, PySPH's .npz. No unit is "
        "changed and nothing is made up. The table says what was read, derived, assumed and left out. CSV, bi4 and "
        "other HDF5 files need no conversion.",
        epilog="example: pairsum convert --fluid water.vtp --boundary wall.vtp out.hdf")
    program.add_argument("files", nargs="*", metavar="FILE", help="files to read, one set together; last, the .hdf to "
                         "write. Their kinds come from a column (Kind, DualSPHysics' Type) or the name of a group; "
                         "without one all particles are fluid")
    program.add_argument("--fluid", metavar="FILE", action="append", default=[], help="a file of fluid particles")
    program.add_argument("--boundary", metavar="FILE", action="append", default=[],
                         help="a file of boundary particles")
    program.add_argument("--boundary-kind", metavar="COLUMN=VALUES", default="",
                         help='which particles of other files are boundary: "Type=0,1", or none')
    program.add_argument("--column", metavar="QUANTITY=NAME", action="append", default=[],
                         help="the column of a quantity (x, y, z, vx, vy, vz, rho, m, h) where the table of names does "
                         "not know it: rho=c_rho, x=Place:0")
    program.add_argument("--frame", metavar="N", type=int, default=-1,
                         help="which one of several, counted from 0, or from the end (default: -1, the last)")
    program.add_argument("--trust-pickles", action="store_true",
                         help="read PySPH's .npz, which holds pickles: they may run any program")
    program.set_defaults(run=_convert)


def _convert(options: argparse.Namespace) -> int:
    from .particles import Asked, convert
    from .particles.guarded import guarded
    from .particles.hdf import unfinished_name

    asked = Asked(options.files[-1] if options.files else "", options.files[:-1], options.fluid, options.boundary,
                  options.boundary_kind, options.column, options.frame, options.trust_pickles)

    def work() -> int:
        _say(convert(asked).rstrip("\n"))
        return 0
    return guarded(lambda: _reported(work), lambda process: unfinished_name(
        pathlib.Path(asked.out), process).unlink(missing_ok=True))


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # whoever reads the output may stop: report FILE | head
    warnings.simplefilter("ignore")  # of libraries, about numbers that the rows hold or about these programs
    sys.exit(main())
