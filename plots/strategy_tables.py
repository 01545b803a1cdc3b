"""The tables of the section on strategies: which rows and columns of the summary each shows."""
import wording
from page_tables import LONG, NUMBER, RATIO, TEXT, TIME, VERDICT, key


def _flag(name, yes, no):
    return lambda row: {True: yes, False: no}.get(row.get(name), "")


def _nested(name):
    """Return the value and the interval of an estimate as one text."""
    def cell(row):
        estimate = row.get(name)
        if not isinstance(estimate, dict):
            return ""
        bounds = wording.interval(estimate)
        return wording.number(estimate.get("value"), 3) + (f" ({bounds})" if bounds else "")
    return cell


def _where(row):
    return row.get("breaks_down") or "not in what was measured"


def _at(row):
    return {"one_thread": "1 thread", "most_threads": "most threads"}.get(row.get("at"), "")


def _rank(rank, of):
    return lambda row: "" if row.get(rank) is None else f"{row[rank]} of {row[of]}"


TABLES = (
    ("strategies", "What they do, and where they break down", "What a backend says of itself. Same bits: for every number "
     "of threads. It breaks down where its interval lies beyond a limit: efficiency below 0.75, on 1 thread above 1.5 times "
     "the serial sweep, in another world above 1.25 times as slow against the base, or 100 bytes a particle more than the "
     "leanest.",
     [("backend", key("backend"), TEXT), ("conflicts", key("conflicts"), TEXT), ("runtime", key("runtime"), TEXT),
      ("each pair", _flag("symmetric", "once", "twice"), TEXT), ("same bits", _flag("deterministic", "yes", "no"), TEXT),
      ("breaks down", _where, LONG), ("also called", key("aliases"), LONG), ("in a line", key("description"), LONG)]),
    ("strategy_ladder", "What they cost", "Ratio: time of the base, on as many threads or fewer, / time, of prepare, zero, "
     "sum and reduce together. Over serial: time on 1 thread / that of sphysics_sweep on the same cells, the price of "
     "keeping apart threads that are not there. Efficiency: speedup over own 1 thread / threads. Wait: share of the threads' "
     "time in the passes spent at barriers and for locks. Extra memory: held by the backend beyond the leanest of the ladder.",
     [("world", key("world"), TEXT), ("ladder", _at, TEXT), ("rank", key("rank"), NUMBER), ("backend", key("backend"), TEXT),
      ("M", key("M"), NUMBER), ("threads", key("threads"), NUMBER), *TIME, ("base", key("base_backend"), TEXT),
      ("base [ms]", key("base_time_s", 1e3), NUMBER), *RATIO, *VERDICT, ("over serial", _nested("over_serial"), NUMBER),
      ("efficiency", _nested("efficiency"), NUMBER), ("wait [%]", key("wait_share", 100, 3), NUMBER),
      ("extra [MiB]", key("extra_bytes", 2.0 ** -20, 3), NUMBER),
      ("extra [B/particle]", key("extra_bytes_per_particle", digits=3), NUMBER)]),
    ("strategy_shifts", "Standing from world to world", "Ratio: time over that of the base in the other world / the same here; below "
     "1 the backend stands worse here, whatever the machine did between the two.",
     [("world", key("world"), TEXT), ("other world", key("base_world"), TEXT), ("backend", key("backend"), TEXT),
      ("threads", key("threads"), NUMBER), *RATIO, *VERDICT, ("rank", _rank("rank", "of"), NUMBER),
      ("other rank", _rank("base_rank", "base_of"), NUMBER)]),
)
