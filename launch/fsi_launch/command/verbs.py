"""What each verb takes: the parsers of the command line."""

import argparse

from fsi_launch import paths
from fsi_launch.failure import UserMistake

REQUESTS = ("pause", "resume", "checkpoint", "stop")


class _Parser(argparse.ArgumentParser):
    """Reports a mistake in one line; exit code 2."""

    def error(self, message):
        verb = "".join(f" {word}" for word in self.prog.split()[1:2])
        raise UserMistake(f"{verb.strip()}{': ' if verb else ''}{message}; {paths.COMMAND}{verb} --help says what it takes")


def _add_case(parser, **options):
    parser.add_argument("case", metavar="CASE", help="a case file, or a name in configs/", **options)
    parser.add_argument("--set", dest="overrides", metavar="KEY=VALUE", action="append", default=[],
                        help="override an entry of the case, e.g. --set grid.factor=8 (repeatable)")
    parser.add_argument("--solid", dest="laws", metavar="NAME=LAW", action="append", default=[],
                        help="give a solid another law, e.g. --solid solid=neo_hookean (repeatable)")


def _levels(text):
    words = text.split(",")
    if not all(word.isdecimal() and int(word) > 0 for word in words):
        raise argparse.ArgumentTypeError(f"'{text}' is no list of whole numbers like 2,4,8")
    return [int(word) for word in words]


def _count(text):
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}' is no number of steps")
    return int(text)


def _plain_number(text):
    """A number in SI units."""
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no number; write it in SI units and without its unit, as 0.08") from None


def _jobs(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of runs: 1 or more")
    return int(text)


def _port(text):
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"'{text}' is no port: 0 to 65535")
    return int(text)


def _named(text):
    """A name of a file or a folder."""
    if not text:
        raise argparse.ArgumentTypeError("'' is no name; write one, or leave the option away")
    return text


def _words(text):
    return [word for word in text.split(",") if word]


def _add_new(verbs):
    from fsi_launch.new.questions import FLOWS, LAWS
    verb = verbs.add_parser("new", description="Writes NAME.yaml, a commented case of one body in a gas in SI units, and checks it. On a "
                            "terminal it asks for what the options leave open.")
    verb.add_argument("name", metavar="NAME", help="of the case; NAME.yaml is written, in this folder or where NAME says")
    verb.add_argument("--outline", metavar="FILE", help="points of the body's outline in their order, x, y on each line (default: a circle)")
    verb.add_argument("--straight", action="store_true", help="straight edges between the points in place of a smooth curve; corners "
                      "are rounded, those of a rigid body sharp where grids take that")
    verb.add_argument("--on-wall", action="store_true", help="the body stands with its lowest edge on the lower wall of the gas, clamped; "
                      "an elastic one of four corners keeps them sharp")
    verb.add_argument("--size", metavar="L", type=_plain_number, help="length of the body [m], to which an outline is scaled (default: the file's "
                      "numbers, in the unit that its heading names, as x_mm,y_mm, or in m; a circle: 0.1)")
    verb.add_argument("--flow", choices=FLOWS, help="a shock that runs against the body (default), or a stream around it")
    verb.add_argument("--mach", metavar="M", type=_plain_number, help="Mach number of the shock (default: 1.3) or of the stream (0.5)")
    verb.add_argument("--density", metavar="RHO", type=_plain_number, help="of the gas [kg/m^3] (default: air, 1.225)")
    verb.add_argument("--pressure", metavar="P", type=_plain_number, help="of the gas [Pa] (default: 101325)")
    verb.add_argument("--gamma", metavar="G", type=_plain_number, help="ratio of its specific heats (default: 1.4)")
    verb.add_argument("--material", metavar="NAME", help="of the body: steel, aluminium, polycarbonate, rubber, .., or RHO,E,NU [kg/m^3, "
                      "Pa, -] (default: aluminium)")
    verb.add_argument("--law", choices=LAWS, help="constitutive law of the body (default: neo_hookean)")
    verb.add_argument("--fixed", action="store_true", help="a rigid body stays where it is")
    verb.add_argument("--end", metavar="T", type=_plain_number, help="end of the run [s] (default: when the shock has passed)")
    verb.add_argument("--cells", metavar="N", type=int, help="cells along the body, at least: their size is rounded down to 1, 2, 2.5 or 5 times "
                      "a power of ten (default: 20)")
    verb.add_argument("--defaults", action="store_true", help="ask nothing")
    verb.add_argument("--overwrite", action="store_true", help="replace a case of that name")


def _add_submit(verbs):
    verb = verbs.add_parser("submit", description="Writes a script with which sbatch runs a case on a cluster with Slurm, and submits nothing. "
                            "With several nodes it is a heterogeneous job. Untested with a real Slurm (docs/scaling.md).")
    _add_case(verb)
    verb.add_argument("--nodes", metavar="N", type=_jobs, default=1, help="nodes: one for the coupler and whatever else, one for each of the "
                      "programs with most ranks (default: 1)")
    verb.add_argument("--ranks", metavar="NAME=N,..", help="as for fsi run")
    verb.add_argument("--time", metavar="HH:MM:SS", help="limit; two minutes before it the run writes a checkpoint and ends (default: the "
                      "partition's, without a checkpoint)")
    verb.add_argument("--option", metavar="OPTION", action="append", default=[], help="further option of sbatch, for each node, such as "
                      "--option=--partition=short (repeatable)")
    verb.add_argument("--results", type=_named, metavar="DIR", help="folder of the results, as --out of fsi run")
    verb.add_argument("--print", action="store_true", help="print the script")
    verb.add_argument("--out", type=_named, metavar="FILE", help="file of the script (default: CASE.sbatch)")
    verb.add_argument("--overwrite", action="store_true", help="replace that file")


def _add_gallery(verbs):
    verb = verbs.add_parser("gallery", description="Validated problems: without NAME lists them; with it runs the case, compares it with exact, "
                            "published or measured numbers, and writes a table and a picture. Exit 1 where a comparison fails.")
    verb.add_argument("problem", metavar="NAME", nargs="?", help="a folder of gallery/")
    verb.add_argument("--out", type=_named, metavar="DIR", help="folder of the run, the table and the picture (default: runs/gallery-NAME-TIME)")
    verb.add_argument("--compare", action="store_true", help="compare the run that is there in DIR/run, and make none")
    verb.add_argument("--overwrite", action="store_true", help="replace the run in DIR")
    verb.add_argument("--no-progress", dest="progress", action="store_false", help="no progress bar")


def _add_run(verbs):
    verb = verbs.add_parser("run", description="Runs a case: checks it, starts its programs, shows the progress, "
                            "and writes the results and summary.json to DIR.")
    _add_case(verb, nargs="?")
    verb.add_argument("--out", type=_named, metavar="DIR", help="folder of the results (default: runs/CASE-TIME)")
    verb.add_argument("--restart", type=_named, metavar="DIR", help="go on with the run in DIR from its last checkpoint; the numbers "
                      "are those of a run that was never interrupted. CASE may be left out; only time.end and "
                      "the time-outs, output but for its probes, and expect may be changed")
    verb.add_argument("--overwrite", action="store_true", help="replace the results of a former run in DIR")
    verb.add_argument("--no-progress", dest="progress", action="store_false", help="no progress bar")
    verb.add_argument("--monitor", action="store_true", help="show the run on the whole terminal, as fsi monitor does; "
                      "with q it goes on with the progress bar")
    verb.add_argument("--pause-at", metavar="N", type=_count, help="pause at step N of the run, until fsi ctl resume: to look at a run, "
                      "or to attach a debugger, at the same place every time")
    verb.add_argument("--ranks", metavar="NAME=N,..", help="let N processes compute a gas or a solid together, e.g. --ranks fluid=4,disk=2; "
                      "auto: as many as there are cores for. The numbers are the same to the bit. Takes Open MPI (docs/scaling.md)")
    verb.add_argument("--hosts", metavar="NAME=HOST,..", help="let participants run on other machines, e.g. --hosts fluid=node2,disk=node3; "
                      "HOST is what ssh takes, or HOST/ADDRESS where its programs shall meet the others at another address. Takes a "
                      "login without password, and a file system that all see at the same place (docs/scaling.md)")
    verb.add_argument("--remote-shell", metavar="COMMAND", help="what starts a command on a machine, in place of ssh: it gets HOST and "
                      "a line for sh (default: $FSI_RSH, or ssh)")
    verb.add_argument("--movie", action="store_true", help="more output times, and an animated file DIR/plots/movie.mp4 of "
                      "them (.gif without ffmpeg)")
    protection = verb.add_mutually_exclusive_group()
    protection.add_argument("--encrypt", dest="protection", action="store_const", const="encrypt",
                            help="nobody else on this machine can read what the programs say to each other; that they "
                            "cannot falsify it is so by default")
    protection.add_argument("--no-security", dest="protection", action="store_const", const="off",
                            help="messages of the programs are not signed: a little faster, but whoever is on this machine "
                            "can read and falsify them")


def _add_check(verbs):
    verb = verbs.add_parser("check", description="Checks a case file and starts nothing.")
    _add_case(verb)
    verb.add_argument("--plot", metavar="FILE", nargs="?", const="", help="draw all its grids at t = 0, unused points left out, "
                      "as .png, .pdf or .svg (default: CASE_grids.png in this folder)")
    verb.add_argument("--ranks", metavar="NAME=N,..", help="say who would have how many processes, as for fsi run; auto: on this machine")


def _add_converge(verbs):
    verb = verbs.add_parser("converge", description="Runs a case on several grids and prints its errors with their "
                            "rates of convergence, or without a reference solution how far its bodies are apart from grid to "
                            "grid; writes them as text, markdown and JSON.")
    _add_case(verb)
    verb.add_argument("--levels", type=_levels, metavar="J,J,..", default=[2, 4, 8],
                      help="grid factors j of h = 1/(10 j) (default: 2,4,8)")
    verb.add_argument("--rates", type=_words, action="extend", metavar="NAME,..", default=[],
                      help="only these errors, e.g. rho,v1 (default: all)")
    verb.add_argument("--min-rate", type=float, metavar="R", help="exit 1 if a fitted rate is below R")
    verb.add_argument("--out", type=_named, metavar="DIR", help="folder of the runs and tables (default: runs/converge-CASE-TIME)")


def _add_study(verbs):
    verb = verbs.add_parser("study", description="Runs a case with every combination of some of its values; prints a table and "
                            "writes it as text, markdown, CSV, JSON and a picture. The same command again makes only the runs that "
                            "are missing.")
    _add_case(verb)
    verb.add_argument("--vary", metavar="KEY=V,V,..", action="append", required=True, help="an entry of the case and its values, "
                      "e.g. --vary parameters.rho_bar=0.01,0.1,1 (repeatable: all combinations)")
    verb.add_argument("--show", type=_words, action="extend", metavar="NAME,..", default=[], help="what the table shows: entries of summary.json like "
                      "interface.max_gap, or TABLE.COLUMN[:last|min|max] like forces_disk.angle:max (default: the errors, or where "
                      "the bodies are at the end)")
    verb.add_argument("--jobs", type=_jobs, metavar="N", default=1, help="runs at the same time (default: 1)")
    verb.add_argument("--out", type=_named, metavar="DIR", help="folder of the runs and tables (default: runs/study-CASE-TIME)")


def _add_test(verbs):
    verb = verbs.add_parser("test", description="Builds everything and runs the tests: unit, programs, convergence, "
                            "regression.")
    verb.add_argument("--quick", action="store_true", help="unit tests only")
    verb.add_argument("-R", dest="pattern", metavar="REGEX", help="only tests whose name matches")


def _add_monitor(verbs):
    verb = verbs.add_parser("monitor", description="Shows a run live until it ends, without disturbing it. RUN is its "
                            "identity, its folder or its case; it may be left out when only one is going on.")
    verb.add_argument("run", metavar="RUN", nargs="?")
    verb.add_argument("--plain", action="store_true", help="a line per second, and when the status changes, instead of the whole terminal")
    verb.add_argument("--once", action="store_true", help="show the state once and exit")
    verb.add_argument("--json", action="store_true", help="JSON, one object per line")
    verb.add_argument("--web", metavar="PORT", type=_port, help="serve a page for browsers, on this machine only; 0 finds a "
                      "free port")
    verb.add_argument("--host", metavar="ADDRESS", help="address of the page (default: 127.0.0.1)")
    verb.add_argument("--record", metavar="FILE", help="write everything that is heard to this HDF5 file")
    verb.add_argument("--replay", metavar="FILE", help="show such a recording, or a run that is over (its folder), instead of one that is going on")
    verb.add_argument("--speed", metavar="X", type=float, help="of the replay: 2 is twice as fast")
    verb.add_argument("--wait", metavar="S", type=float, help="longest wait of --once for the first word of everybody [s]")


def _add_ctl(verbs):
    verb = verbs.add_parser("ctl", usage="fsi ctl [RUN] pause|resume|checkpoint|stop", description="Asks a run to pause, "
                            "to go on, to write a checkpoint, or to write one and stop gracefully (status "
                            "\"stopped\"). RUN as for monitor.")
    verb.add_argument("words", metavar="[RUN] REQUEST", nargs="+", help=", ".join(REQUESTS))


def _add_plot(verbs):
    verb = verbs.add_parser("plot", description="Draws the results of a run, or the table of fsi converge, as "
                            "pictures into DIR/plots. Of several runs it draws what can be compared.")
    verb.add_argument("directories", metavar="DIR", nargs="+", help="folder of a run or of fsi converge")
    verb.add_argument("--at", metavar="TIME", type=float, action="append", default=[], help="draw this output time alone; "
                      "may be given several times")
    verb.add_argument("--contours", action="store_true", help="contour lines over the fields")
    verb.add_argument("--movie", action="store_true", help="also an animated file, one frame per output (.mp4, .gif without "
                      "ffmpeg)")
    verb.add_argument("--format", choices=("png", "pdf", "svg"), default="png", help="of the pictures (default: png)")
    verb.add_argument("--out", type=_named, metavar="DIR", help="folder of the pictures (default: plots in the first DIR)")


def _add_faults(verbs):
    verb = verbs.add_parser("faults", description="Sends signals to the programs of a run at random moments, many "
                            "times, and checks how it ends, what is left, and that its restart gives the same bits. "
                            "Exit 1 where anything was wrong.")
    verb.add_argument("--count", type=int, metavar="N", default=200, help="trials (default: 200)")
    verb.add_argument("--seed", type=int, metavar="S", default=1, help="of targets and moments (default: 1)")
    verb.add_argument("--jobs", type=int, metavar="N", default=2, help="trials at the same time (default: 2)")
    verb.add_argument("--out", type=_named, metavar="FILE", help="JSON with one entry per trial")


def _add_bench(verbs):
    verb = verbs.add_parser("bench", description="Runs all benchmarks; prints one table and writes JSON.")
    verb.add_argument("--quick", action="store_true", help="a short look: fewer repetitions")
    verb.add_argument("--filter", metavar="REGEX", default="", help="only benchmarks whose name matches")
    verb.add_argument("--out", type=_named, metavar="FILE", default="build/bench.json", help="JSON file (default: build/bench.json)")


def _add_docs(verbs):
    verb = verbs.add_parser("docs", description="Makes the pages of docs/ a site in build/site, and opens it.")
    verb.add_argument("--no-open", dest="open", action="store_false", help="print only where it is")


def _add_schema(verbs):
    verbs.add_parser("schema", description="Prints the JSON Schema of case files, by which editors complete and check them.")


def _add_completion(verbs):
    verbs.add_parser("completion", description="Prints a script for bash that completes verbs, options and cases: "
                     f"source <({paths.COMMAND} completion)")


VERBS = {"run": _add_run, "new": _add_new, "check": _add_check, "converge": _add_converge, "study": _add_study, "gallery": _add_gallery,
         "submit": _add_submit, "test": _add_test, "monitor": _add_monitor, "ctl": _add_ctl, "plot": _add_plot, "faults": _add_faults,
         "bench": _add_bench, "docs": _add_docs, "schema": _add_schema, "completion": _add_completion}


def parser(verb=None):
    """The parser of one verb, which is there sooner than that of all; of all where there is none of that name."""
    one = _Parser(prog="fsi", add_help=False)
    verbs = one.add_subparsers(dest="verb", required=True, parser_class=_Parser)
    for add in [VERBS[verb]] if verb in VERBS else VERBS.values():
        add(verbs)
    return one
