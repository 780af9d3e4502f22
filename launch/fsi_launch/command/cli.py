"""The command line: verbs and their exit codes."""

import os
import signal
import sys

from fsi_launch import paths, version
from fsi_launch.command import verbs
from fsi_launch.living import interrupts
from fsi_launch.failure import DONE, Failure, INTERRUPTED, NOBODY_READS, OUTPUT_FAILED, TERMINATED, UserMistake
from fsi_launch.telling import names_as_they_are, silence, tell

USAGE = (paths.ROOT / "launch" / "usage.txt").read_text(encoding="utf-8")


def _run(options):
    from fsi_launch.run import Request, run
    if options.movie:
        from fsi_launch import plot
        plot.style_or_mistake()
    result = run(Request(case=options.case, overrides=options.overrides, laws=options.laws, out=options.out,
                         overwrite=options.overwrite, restart=options.restart, progress=options.progress, pause_at=options.pause_at,
                         monitor=options.monitor, protection=options.protection, frames=options.movie,
                         ranks=options.ranks, hosts=options.hosts, remote_shell=options.remote_shell))
    if options.movie and result.summary["status"] in ("completed", "stopped"):
        plot.draw_movie(result.directory)
    elif options.movie:
        tell(f"no movie is made of a run that failed; `fsi plot {result.directory} --movie` makes one of the outputs there are")
    return result.code


def _submit(options):
    from fsi_launch import submit
    return submit.main(options)


def _check(options):
    from fsi_launch import check
    return check.main(options)


def _new(options):
    from fsi_launch import new
    return new.main(options)


def _gallery(options):
    from fsi_launch import gallery
    return gallery.main(options)


def _converge(options):
    from fsi_launch.studies import converge
    return converge.main(options)


def _study(options):
    from fsi_launch.studies import study
    return study.main(options)


def _test(options):
    from fsi_launch.trials import testing
    return testing.main(options)


def _bench(options):
    from fsi_launch.trials import bench
    return bench.main(options)


def _faults(options):
    from fsi_launch.trials import faults
    return faults.main(options)


def _plot(options):
    from fsi_launch import plot
    return plot.main(options)


def _monitor(options):
    """Becomes the monitor program."""
    words = [f"--{name}" for name in ("once", "json", "plain") if getattr(options, name)]
    for name in ("wait", "record", "replay", "speed", "web", "host"):
        if (value := getattr(options, name)) is not None:
            words += [f"--{name}", str(value)]
    return _become("monitor", *words, *([options.run] if options.run else []))


def _ctl(options):
    *run, request = options.words
    if len(run) > 1 or request not in verbs.REQUESTS:
        raise UserMistake(f"ctl: write [RUN] and one of {', '.join(verbs.REQUESTS)}")
    return _become("monitor", *run, "--send", request)


def _docs(options):
    from fsi_launch import site
    return site.main(options)


def _schema(_):
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)   # whoever read it, as `head`, may go
    return _become("fsi_case", "schema")


def _completion(_):
    from fsi_launch.command import completion
    print(completion.script(verbs.parser()), end="")
    return DONE


def _become(name, *words):
    program = paths.program(name)
    sys.stdout.flush()
    os.execv(program, [program, *words])


ACTS = {"run": _run, "new": _new, "check": _check, "converge": _converge, "study": _study, "gallery": _gallery, "submit": _submit,
        "test": _test, "monitor": _monitor, "ctl": _ctl, "plot": _plot, "faults": _faults, "bench": _bench, "docs": _docs,
        "schema": _schema, "completion": _completion}


def _nobody_reads():
    """Whoever read the output, as `head`, has gone: that is no failure to be told of. What is still to be written goes nowhere."""
    silence(sys.stdout)
    return NOBODY_READS


def _act(arguments):
    if not arguments or arguments[0] in ("-h", "--help", "help"):
        print(USAGE, end="")
        return DONE
    if arguments == ["--version"]:
        print(version.describe())
        return DONE
    interrupts.listen()
    parser = verbs.parser(arguments[0])
    options, unknown = parser.parse_known_args(arguments)
    if unknown:
        from fsi_launch.command import completion
        option = completion.meant(parser, options.verb, unknown)
        hint = f" (did you mean {option}?)" if option else ""
        raise UserMistake(f"{options.verb}: it takes no {' '.join(unknown)}{hint}; {paths.COMMAND} {options.verb} --help says what it takes")
    return ACTS[options.verb](options)


def main(arguments):
    """Returns the exit code."""
    names_as_they_are()
    try:
        code = _act(arguments)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        return _nobody_reads()
    except Failure as failure:
        tell(f"fsi: {failure}")
        return failure.code
    except KeyboardInterrupt:
        tell("fsi: interrupted (Ctrl-C)")
        return INTERRUPTED
    except interrupts.Terminated:
        tell("fsi: ended on request (SIGTERM)")
        return TERMINATED
    except OSError as error:
        if error.filename is None:
            silence(sys.stdout)
        tell(f"fsi: {error.filename or 'output'}: {error.strerror or error}")
        return OUTPUT_FAILED
