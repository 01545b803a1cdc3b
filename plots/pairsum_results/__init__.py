"""Results of pairsum: rows in; tidy tables, comparisons, answers, figures and a page out.

    import pairsum_results as pr
    results = pr.load(["results/field"])
    results.points[["case", "backend", "threads", "sum_s", "sum_s_low", "sum_s_high"]]
    pr.speedup(results)[["backend", "threads", "ratio", "low", "high", "verdict"]]
    pr.report(results).answer.text
"""
import sys

try:
    from .answers import Answer, answer  # noqa: F401
    from .compare import (algorithm_speedup, compared, compiler_comparison, m_comparison,  # noqa: F401
                          runtime_comparison, speedup)
    from .densities import density  # noqa: F401
    from .ladders import ladder, shifts, standings, strategies  # noqa: F401
    from .load import COMMON, EVALUATION, PLACE, POINT, TIMES, Results, load  # noqa: F401
    from .model import models, shares, thread_times  # noqa: F401
    from .reports import Report, report  # noqa: F401
    from .rows import PHASES, ResultsError  # noqa: F401
    from .scaling import scaling  # noqa: F401
    from .self_tests import self_test  # noqa: F401
except ModuleNotFoundError as problem:
    if sys.argv[:1] != ["-m"]:  # imported by a program of somebody's own
        raise
    print(f"pairsum: {sys.executable} lacks {problem.name} (Debian: python3-pandas, python3-scipy)", file=sys.stderr)
    sys.exit(2)
