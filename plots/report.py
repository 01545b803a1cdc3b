"""Make one self-contained page of summaries. Try: python3 plots/report.py --help"""
import argparse
import base64
import hashlib
import importlib
import os
import pathlib
import sys

import summary as summaries

_HERE = pathlib.Path(__file__).resolve().parent
_HELP = """\
Make one report.html of a summary that `pairsum report` made: the answer, the questions, figures,
tables, environments and caveats. The page is one file and loads nothing from anywhere.
"""
_MORE = """\
Nothing is computed here: what the page says stands in the summary. With --compare, several
machines stand side by side. Exit code: 0, or 2 with one line on stderr.

example: /usr/bin/python3 plots/report.py summary.json --out report.html
"""


def main(arguments=None):
    """Run the program; return its exit code."""
    options = _parser().parse_args(arguments)
    try:
        data = [summaries.load(path) for path in [options.summary, *options.compare]]
        write(page(data), options.out)
    except summaries.SummaryError as problem:
        print(f"report.py: {' '.join(str(problem).split())}", file=sys.stderr)
        return 2
    print(f"report: {options.out}")
    return 0


def _parser():
    parser = argparse.ArgumentParser(prog="report.py", description=_HELP, epilog=_MORE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("summary", metavar="SUMMARY.json", help="the summary to show")
    parser.add_argument("--out", metavar="FILE", default="report.html", help="the page (default: report.html)")
    parser.add_argument("--compare", metavar="OTHER.json", nargs="+", default=[],
                        help="summaries of other machines, shown beside the first")
    return parser


def page(data):
    """Return the HTML of checked summaries."""
    try:
        jinja2 = importlib.import_module("jinja2")
        importlib.import_module("style").apply()
        content, tables, strategy_tables = map(importlib.import_module, ("page", "page_tables", "strategy_tables"))
    except ImportError as problem:
        raise summaries.SummaryError(
            f"needs matplotlib, numpy and jinja2 for {sys.executable}: {problem} (Debian: "
            "python3-matplotlib, python3-numpy, python3-jinja2)") from None
    script = (_HERE / "report.js").read_text(encoding="utf-8")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    markup = importlib.import_module("markupsafe").Markup
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True,
                                     undefined=jinja2.StrictUndefined)
    return environment.get_template("report.html.j2").render(
        **content.content(data, markup), tables=tables.of(data),
        strategy_tables=tables.of(data, strategy_tables.TABLES), script=markup(script), script_hash=f"sha256-{digest}",
        style=markup((_HERE / "report.css").read_text(encoding="utf-8")))


def write(text, path):
    """Write the page; it appears whole or not at all."""
    unfinished = f"{path}.{os.getpid()}.unfinished"
    try:
        with open(unfinished, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(unfinished, path)
    except OSError as problem:
        raise summaries.SummaryError(f"cannot write {path}: {problem.strerror}") from None
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


if __name__ == "__main__":
    sys.exit(main())
