"""Condenses summaries that `pairsum report` made (pairsum.summary/2) to what the golden test compares.

    python3 make_golden.py FOLDER/*/summary.json > golden.json
"""
import json
import pathlib
import sys

PLACE = ["series", "backend", "grid", "isa", "block", "granularity", "M", "threads"]
BOUNDS = ["low", "high"]


def condensed(summary: dict) -> dict:
    """Lists of rows by table; a point is its number."""
    places = {tuple({**e["point"], "series": e["series"]}[k] for k in PLACE): n for n, e in enumerate(summary["points"])}

    def at(e, **other):
        return places[tuple({**e, **other}[k] for k in PLACE)]

    def base_of(e):
        return at(e, **{k: e[f"base_{k}"] for k in ("backend", "M", "granularity", "threads") if f"base_{k}" in e})

    def point(e):
        phases = [e["phases"][name][end] for name in ("sum_s", "total_s") for end in ("median", *BOUNDS)]
        return [*phases, e["phases"]["sum_s"]["confidence"], e["rounds"], e["variance"]["between"],
                e["variance"]["within"], (e["passes"] or {}).get("wait_share"), e["ns_per_pair"]]

    def rung(e):
        one = [e[key] and e[key][end] for key in ("over_serial", "efficiency") for end in ("value", *BOUNDS)]
        return [at(e), e["base_backend"], e["at"], e["rank"], e["of"], e["time_s"], e["ratio"], e["low"], e["high"],
                e["verdict"], *one, e["extra_bytes"], e["world"]]

    answer = summary["answer"]
    return {
        "points": [point(e) for e in summary["points"]],
        "speedup": [[at(e), base_of(e), e["speedup"], e["low"], e["high"], e["rounds"], e["verdict"],
                     e["machine_flops_scaling"], *(e[key][end] for key in ("machine_speedup", "of_machine")
                                                   for end in ("value", *BOUNDS))] for e in summary["speedup"]],
        "algorithm_speedup": [[at(e), base_of(e), e["speedup"], e["low"], e["high"], e["rounds"], e["verdict"]]
                              for e in summary["algorithm_speedup"]],
        "runtime_comparison": [[at(e, backend=e["algorithm"] + "_tbb", granularity=e["tbb_granularity"]),
                                at(e, backend=e["algorithm"] + "_omp"), e["ratio"], e["low"], e["high"], e["rounds"],
                                e["verdict"]] for e in summary["runtime_comparison"]],
        "m_comparison": [[at(e), e["best_M"], e["over_best"], e["verdict"], e["collision_share"], e["useful_pair_ratio"]]
                         for e in summary["m_comparison"]],
        "ladder": [rung(e) for e in summary["strategy_ladder"]],
        "over_threads": [[at(e), e["base_backend"], e["ratio"], e["low"], e["high"], e["rounds"]]
                         for e in summary["strategy_threads"]],
        "shifts": [[e["series"], e["backend"], e["base_series"], e["what"], e["rank"], e["base_rank"], e["ratio"], e["low"],
                    e["high"], e["verdict"]] for e in summary["strategy_shifts"]],
        "breaks_down": [[e["backend"], e["breaks_down"]] for e in summary["strategies"]],
        "self_test": sorted([e["backend"], e["threads"], e["expected"], e["ratio"], e["low"], e["high"], e["confidence"],
                             e["holds"]] for e in summary["self_test"]),
        "answer": answer and [[at(answer), answer["text"], answer["details"], answer["speedup"], answer["low"],
                               answer["high"], [at({**t, "series": answer["series"]}) for t in answer["ties"]]]],
        "questions": [[q["question"], q["answer"]] for q in summary["questions"]],
        "failed": [[f["point"]["backend"], f["point"]["threads"], f["rows"], f["error"]] for f in summary["failed"]],
        "caveats": [[c] for c in summary["caveats"]],
        "peaks": [[p["threads"], p["precision"], p["bandwidth_bytes_per_s"], p["flops_per_s"]] for p in summary["peaks"]],
        "rounds": [[summary["rounds"]["finished"], summary["rounds"]["void"], summary["rounds"]["others_share"]]],
        "phases": [[e["phases"][name][end] for name in e["phases"] for end in ("median", *BOUNDS)]
                   for e in summary["points"]]}


def rounded(value):
    """Ten digits, half a unit of which is less than the test allows."""
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.10g}") if isinstance(value, float) else value


def main(paths: list[str]) -> None:
    found = {}
    for path in map(pathlib.Path, paths):
        tables = condensed(json.loads(path.read_text()))
        del tables["phases"]
        found[json.loads(path.read_text())["sources"][0]] = {
            name: [json.dumps(rounded(row)) for row in rows or []] for name, rows in tables.items()}
    # One row per line.
    print("{" + ",\n".join(f'{json.dumps(source)}: {{' + ",\n".join(
        f'"{name}": [\n' + ",\n".join(rows) + "]" for name, rows in tables.items()) + "}"
        for source, tables in found.items()) + "}")


if __name__ == "__main__":
    main(sys.argv[1:])
