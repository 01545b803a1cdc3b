"""The figures in the order of the report: what each shows, for captions and for readers who cannot see it."""

#: name -> (heading, caption). A figure of SERIES is drawn for each series of points by itself.
FIGURES = {
    "ladder": ("All backends", "Time per interacting pair of every backend at its best grid and M, the fastest on "
               "top. A bar stacks prepare, zero, sum and reduce; the number is all of it, in brackets the sum alone."),
    "speedup": ("Speedup", "Summation time with 1 thread over that with more threads, of the same backend. Grey: "
                "ideal, and how the measured flops and memory bandwidth of the machine itself scale."),
    "efficiency": ("Efficiency", "Speedup divided by the number of threads; 1 is ideal."),
    "algorithm_speedup": ("Algorithm speedup", "How many times faster the labelled backend is than the base, with "
                          "the same runtime and threads; 1 is no gain."),
    "m_comparison": ("Choice of M", "Summation time against M, then why: distance tests, the share of them that "
                     "folding cells onto 2^(dM) adds (collisions), useful pairs, and non-empty cells."),
    "phase_split": ("Phases of a step", "Where the time of a step goes: medians of the phases, stacked; the black "
                    "mark is the whole step."),
    "barrier_wait": ("Waiting at barriers", "One bar per thread: time spent summing (solid) and waiting for other "
                     "threads (light), all passes; the number is the share of the wait."),
    "roofline": ("Roofline", "Achieved flops per second against flops per byte (a model of the work). Grey: what "
                 "the measured memory bandwidth and peak allow. Large markers: each backend at its best grid "
                 "and M."),
    "size_scaling": ("Size", "Time per sum and per interacting pair against the number of particles, each backend "
                     "at its best grid and M."),
    "granularity": ("Granularity", "Summation time against the chunk of the parallel loop, a line per schedule; a "
                    "schedule without a chunk is a level line."),
    "compilers": ("Compilers", "The same source built by several compilers: time with the base compiler over time "
                  "with the other; right of 1 the other is faster."),
    "self_test": ("Self-test", "Does the harness find known differences, and none where there is none? Dot: "
                  "measured ratio; line: its interval; tall mark: expected."),
}
#: The figures of the section on strategies.
STRATEGIES = {
    "strategy_ladder": ("Ladder of strategies", "How many times as fast as the base each backend gets the rates: prepare, "
                        "zero, sum and reduce together, mean over the steps. Black lines: intervals. Colours: how threads "
                        "are kept apart."),
    "strategy_threads": ("Strategies over threads", "Times as fast as the base on one thread; a steep line gains from "
                         "threads. Colours: how threads are kept apart."),
    "strategy_worlds": ("From world to world", "Each backend against the base in every world: markers far to the left of "
                        "its others are where it breaks down."),
}
SERIES = ("ladder", "speedup", "efficiency", "algorithm_speedup", "m_comparison", "phase_split", "barrier_wait",
          "roofline", "granularity")
