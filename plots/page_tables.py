"""The tables of the report: which rows and columns of the summary each shows."""
import environments
import wording

NUMBER, TEXT, LONG = "number", "", "long"


def key(name, scale=1.0, digits=4):
    def cell(row):
        value = row.get(name)
        if value is None or isinstance(value, (str, bool)):
            return {None: "", True: "yes", False: "NO"}.get(value, value)
        return wording.number(value if scale == 1.0 else scale * value, digits)
    return cell


def _in_ms(row):
    return wording.interval({key: None if row.get(key) is None else 1e3 * row[key] for key in ("low", "high")})


def _plain_dx(row):
    return "" if row.get("dx") is None else f"{row['dx']:g}"


_WORLD = [("case", key("case"), TEXT), ("state", key("state"), TEXT), ("dx [m]", _plain_dx, NUMBER),
          ("build", key("build"), TEXT)]
_VARIED = [("grid", key("grid"), TEXT), ("isa", key("isa"), TEXT), ("block", key("block"), TEXT)]
_POINT = [("backend", key("backend"), TEXT), *_VARIED, ("M", key("M"), NUMBER), ("threads", key("threads"), NUMBER)]
_GRAIN = [("granularity", key("granularity"), TEXT)]
TIME = [("time [ms]", key("time_s", 1e3), NUMBER)]
_BASE = [("base [ms]", key("base_time_s", 1e3), NUMBER)]
RATIO = [("ratio", key("ratio", digits=3), NUMBER), ("interval", wording.interval, NUMBER)]
_SPEEDUP = [("speedup", key("speedup", digits=3), NUMBER), ("interval", wording.interval, NUMBER)]
VERDICT = [("verdict", key("verdict"), TEXT)]

#: name in the summary, heading, caption, columns; a column without any value is left out.
TABLES = (
    ("points", "Points", "Medians over rounds. The interval is of the sum.",
     _WORLD + _POINT + _GRAIN + [("sum [ms]", key("time_s", 1e3), NUMBER), ("interval [ms]", _in_ms, NUMBER),
      ("step [ms]", key("total_s", 1e3), NUMBER), ("ns per pair", key("ns_per_pair"), NUMBER),
      ("useful pairs [%]", key("useful_pair_ratio", 100, 3), NUMBER),
      ("filled lanes [%]", key("occupancy", 100, 3), NUMBER), ("blocks made", key("block_made"), TEXT),
      ("wait [%]", key("wait_share", 100, 3), NUMBER), ("of the bound [%]", key("share_of_bound", 100, 3), NUMBER),
      ("limited by", key("limited_by"), TEXT), ("between rounds [%]", key("between", 100, 2), NUMBER),
      ("rounds", key("rounds"), NUMBER)]),
    ("speedup", "Speedup", "Over the same backend with 1 thread.",
     _WORLD + _POINT + _GRAIN + TIME + _BASE + _SPEEDUP + [("efficiency", key("efficiency", digits=3), NUMBER)]),
    ("algorithm_speedup", "Algorithm speedup", "Over the base backend with the same runtime and threads.",
     _WORLD + _POINT + _GRAIN + TIME + [("base", key("base_backend"), TEXT), ("base M", key("base_M"), NUMBER)]
     + _BASE + _SPEEDUP + VERDICT),
    ("runtime_comparison", "OpenMP against oneTBB", "Ratio: time with OpenMP / time with oneTBB.",
     _WORLD + _VARIED + [("algorithm", key("algorithm"), TEXT), ("M", key("M"), NUMBER), ("threads", key("threads"), NUMBER),
      ("OpenMP [ms]", key("omp_time_s", 1e3), NUMBER), ("oneTBB [ms]", key("tbb_time_s", 1e3), NUMBER)]
     + RATIO + VERDICT),
    ("compiler_comparison", "Compilers", "Ratio: time with the base compiler / time.",
     _WORLD + _POINT + _GRAIN + [("compiler", key("compiler"), TEXT)] + TIME
     + [("base compiler", key("base_compiler"), TEXT)] + _BASE + RATIO + VERDICT),
    ("m_comparison", "Choice of M", "The interval is of the summation time.",
     _WORLD + _POINT + [("sum [ms]", key("time_s", 1e3), NUMBER), ("interval [ms]", _in_ms, NUMBER),
      ("step [ms]", key("total_s", 1e3), NUMBER), ("non-empty cells", key("cells_nonempty"), NUMBER),
      ("pairs tested", key("pairs_tested"), NUMBER), ("collisions [%]", key("collision_share", 100, 3), NUMBER),
      ("useful pairs [%]", key("useful_pair_ratio", 100, 3), NUMBER)]),
    ("peaks", "Measured peaks", "Memory bandwidth and flops that the machine reached.",
     [("environment", key("build"), TEXT), ("threads", key("threads"), NUMBER),
      ("precision", key("precision"), TEXT),
      ("GB/s", key("bandwidth_bytes_per_s", 1e-9), NUMBER), ("Gflop/s", key("flops_per_s", 1e-9), NUMBER)]),
    ("self_test", "Self-test", "Ratio: time / time of the base.",
     [("check", key("what"), TEXT)] + _POINT + [("expected", key("expected", digits=3), NUMBER)] + RATIO
     + [("holds", key("holds"), TEXT), ("in words", key("text"), LONG)]),
    ("failed", "Failed points", "Points without a verified result; their times do not count.",
     _WORLD + _POINT + [("error", key("error"), LONG)]),
)


def of(summaries, tables=TABLES):
    """Return the tables that at least one of the summaries fills, one column per summary."""
    found = []
    for name, heading, caption, columns in tables:
        contents = [_content(summary, name, columns) for summary in summaries]
        if any(content["rows"] for content in contents):
            found.append({"name": name, "heading": heading, "caption": caption, "columns": contents})
    return found


def _content(summary, name, columns):
    rows = [_flat(summary, name, row) for row in summary.get(name) or [] if isinstance(row, dict)]
    cells = [[cell(row) for _, cell, _ in columns] for row in rows]
    world = [heading for heading, _, _ in _WORLD + _VARIED]
    keep = [at for at, (heading, _, _) in enumerate(columns)
            if len({row[at] for row in cells} - {""}) > (1 if heading in world else 0)]
    return {"heads": [{"text": columns[at][0], "kind": columns[at][2]} for at in keep],
            "rows": [[row[at] for at in keep] for row in cells]}


def _flat(summary, name, row):
    """Return a row with what a column needs at its top: of points the figures that lie deeper."""
    if name in ("points", "failed") and isinstance(row.get("point"), dict):
        some = row.get("phases") or {}
        total, time = (some.get(phase) or {} for phase in ("total_s", "sum_s"))
        units = (row.get("work") or {}).get("vector_units") or {}
        row = {"occupancy": units.get("occupancy"), "block_made": units.get("block"),
               **row["point"], **(row.get("passes") or {}), **(row.get("model") or {}),
               **(row.get("variance") or {}), **row,
               "low": time.get("low"), "high": time.get("high"),
               "time_s": time.get("median"), "total_s": total.get("median")}
    identity, series = row.get("environment"), summary.get("series") or []
    if isinstance(row.get("series"), int) and row["series"] < len(series):
        identity = series[row["series"]].get("environment")
    return {**row, "build": environments.name(summary, identity) or ""}
