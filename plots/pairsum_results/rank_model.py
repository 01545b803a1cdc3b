"""What an evaluation should take on more ranks than were measured (docs/model.md, "Many ranks"): arguments in, a table
of predictions out."""
import math
from collections.abc import Mapping

import numpy as np
import pandas as pd

#: Messages back, bytes of rates and the part of the cut pairs that a rank sums, by who sums a pair of two ranks.
MODES = {"twice": (0, 1.0), "once": (1, 0.5)}
#: Numbers of ranks whose boxes are halves of halves.
RANKS = tuple(2**k for k in range(13))


def cuts(ranks: int) -> list[int]:
    """Parts along each axis of a cube that is halved along its axes in turn; `ranks` is a power of two."""
    halvings = ranks.bit_length() - 1
    if ranks < 1 or ranks != 2**halvings:
        raise ValueError(f"predictions are for 1, 2, 4, 8, ... ranks, not {ranks}")
    return [2 ** ((halvings + 2 - axis) // 3) for axis in range(3)]


def share(particles: float, reach: float, parts: list[int], skin: float = 0.0) -> dict[str, float]:
    """Of a rank's box of a periodic cube of `particles` particles, cut into `parts` along its axes: `own` and `ghosts`;
    `cut_share`, the mean part of its particles' partners that are ghosts, for a cutoff of `reach` spacings;
    `neighbours`, its messages. Ghosts come from as far as the cutoff and the `skin`, in units of the cutoff. The last
    three are null where the box is narrower than that along a cut axis, for which these numbers do not hold."""
    edge = np.cbrt(particles)
    if edge < 3 * reach:
        raise ValueError(f"a periodic cube is at least 3 cutoffs wide, {3 * reach:g} spacings, this one {edge:g}")
    widths, halo = [edge / p for p in parts], reach * (1 + skin)
    own = math.prod(widths)
    if any(p > 1 and w < halo for p, w in zip(parts, widths)):
        return {"own": own, "ghosts": math.nan, "cut_share": math.nan, "neighbours": math.nan}
    a, b, c = (reach / w if p > 1 else 0.0 for p, w in zip(parts, widths))
    kept = 1 - 3 / 8 * (a + b + c) + 2 / (5 * math.pi) * (a * b + b * c + c * a) - a * b * c / (8 * math.pi)
    around = math.prod(min(edge, w + 2 * halo) for w in widths)
    return {"own": own, "ghosts": around - own, "cut_share": 1 - kept,
            "neighbours": math.prod(min(p, 3) for p in parts) - 1}


def predictions(link: Mapping[str, float], costs: Mapping[str, float], *, particles: float, pairs_per_particle: float,
                reach: float | None = None, skin: float = 0.1, particle_bytes: float = 56, rates_bytes: float = 32,
                ranks=RANKS) -> pd.DataFrame:
    """The time of one evaluation, `time_s`, for every number of `ranks`, in both modes, `scaling` "strong" (`particles`
    in all) and "weak" (`particles` a rank). The particles fill a periodic cube.

    `link` has `latency_s` of a message and `bandwidth_bytes_per_s` between two ranks, as a ping-pong measures them;
    `costs` has `s_per_particle` (own or ghost) and `s_per_pair`, as one rank measures them. `pairs_per_particle` are
    interacting pairs, each counted once; `reach` is the cutoff in spacings, if not given that of the ball that holds
    twice as many particles; `skin`: how much farther ghosts come from, in units of the cutoff. The bytes are those of a
    ghost's present values and of its rates (the defaults: `ferrari09` in 3D and double).

    `speedup` is against one rank, `efficiency` per rank ("weak": time of one rank over that of many). `work_s` and
    `messages_s` make up the time. `source` is "model" in every row. Null where a rank's box is narrower than the
    cutoff and the skin.
    Raises ValueError for numbers that are not positive and finite."""
    if reach is None:
        reach = np.cbrt(2 * pairs_per_particle * 3 / (4 * math.pi))
    numbers = {**{name: link[name] for name in ("latency_s", "bandwidth_bytes_per_s")},
               **{name: costs[name] for name in ("s_per_particle", "s_per_pair")},
               "particles": particles, "pairs_per_particle": pairs_per_particle, "reach": reach,
               "particle_bytes": particle_bytes, "rates_bytes": rates_bytes}
    for name, value in numbers.items():
        if not (value > 0 and math.isfinite(value)):
            raise ValueError(f"{name} should be positive and finite, is {value}")
    if not (skin >= 0 and math.isfinite(skin)):
        raise ValueError(f"skin should be finite and not negative, is {skin}")
    rows = []
    for scaling in ("strong", "weak"):
        for mode, (back, summed) in MODES.items():
            for n in ranks:
                one = share(particles * (n if scaling == "weak" else 1), reach, cuts(n), skin)
                partners = one["own"] * 2 * pairs_per_particle
                cut = partners * one["cut_share"]
                pairs = (partners - cut) / 2 + summed * cut
                messages, sent = one["neighbours"] * (1 + back), one["ghosts"] * (particle_bytes + back * rates_bytes)
                rows.append({
                    "source": "model", "scaling": scaling, "mode": mode, "ranks": n, "particles_per_rank": one["own"],
                    "ghosts_per_particle": one["ghosts"] / one["own"], "pairs": pairs, "cut_pairs": cut,
                    "messages": messages, "bytes": sent,
                    "work_s": costs["s_per_particle"] * (one["own"] + one["ghosts"]) + costs["s_per_pair"] * pairs,
                    "messages_s": messages * link["latency_s"] + sent / link["bandwidth_bytes_per_s"]})
    table = pd.DataFrame(rows)
    table["time_s"] = table["work_s"] + table["messages_s"]
    alone = costs["s_per_particle"] * particles + costs["s_per_pair"] * particles * pairs_per_particle
    weak = table["scaling"] == "weak"
    table["speedup"] = alone / table["time_s"] * np.where(weak, table["ranks"], 1)
    table["efficiency"] = table["speedup"] / table["ranks"]
    return table
