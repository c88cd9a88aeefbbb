"""The command line.

Exit status: 0 it worked, 1 it ran and failed, 2 wrong use. Errors are one line on standard error.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from .errors import KirbyError, UsageError
from .view_options import DEFAULT_PORT, LOOPBACK, ViewOptions

_HELP = ["-h", "--help"]

app = typer.Typer(
    name="kirby",
    context_settings={"help_option_names": _HELP},
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    add_completion=False,
)

# Typer carries a click of its own, and of its exceptions exports this one's subclass alone.
_WrongUse: Any = typer.BadParameter.__base__

WorldOption = Annotated[
    str | None, typer.Option("--world", metavar="NAME|FILE", help="A world by name, or a YAML file of your own.")
]
RedisOption = Annotated[
    str | None, typer.Option("--redis", metavar="URL", help="A Redis to use instead of one that Kirby starts.")
]
SpeedOption = Annotated[
    str | None,
    typer.Option("--speed", metavar="X", help="Simulated seconds a second, or 'max' (1; from a pipe, max)."),
]
StateOption = Annotated[
    Path | None, typer.Option("--state", metavar="DIR", help="Where Kirby keeps its queue and history.")
]
SeedOption = Annotated[int | None, typer.Option("--seed", help="Seed of the simulated noise (the world's).")]
NamespaceOption = Annotated[str, typer.Option("--namespace", help="Prefix of every key, one for each robot.")]
LogOption = Annotated[
    Path | None,
    typer.Option("--log", metavar="FILE", help="Write every event and what came of it, for kirby replay."),
]
ViewOption = Annotated[bool, typer.Option("--view", help="Show the world in a browser as well.")]
HostOption = Annotated[
    str, typer.Option("--host", help="Where the view listens; beyond this machine it asks for a token.")
]
PortOption = Annotated[int, typer.Option("--port", min=0, max=65535, help="The view's port; 0 takes a free one.")]


@app.callback(epilog="Without a command it is kirby repl. Example: kirby --world figure3")
def _group() -> None:
    """Steer a mobile robot with English and gesture through a shared virtual world."""


@app.command(epilog="Example: printf 'go forward\\nturn left\\n' | kirby repl --world figure3")
def repl(
    world: WorldOption = None,
    redis: RedisOption = None,
    speed: SpeedOption = None,
    state: StateOption = None,
    seed: SeedOption = None,
    namespace: NamespaceOption = "",
    view: ViewOption = False,
    host: HostOption = LOOPBACK,
    port: PortOption = DEFAULT_PORT,
    log: LogOption = None,
) -> None:
    """Talk to Kirby. Lines from a pipe are said in turn, each when the robot is idle or asks something."""
    from .session import Options, talk

    shown = ViewOptions(host, port) if view else None
    options = Options(world, redis, speed, state, seed, namespace, shown, log)
    raise typer.Exit(0 if talk(options) else 1)


@app.command(epilog="Example: kirby replay talk.jsonl")
def replay(log: Annotated[Path, typer.Argument(help="A log that 'kirby repl --log' wrote.")]) -> None:
    """Go through a logged talk again, without a robot, and show that the same comes of it."""
    from .replay import replay as replay_log

    raise typer.Exit(0 if replay_log(log) else 1)


@app.command(epilog="Example: kirby view --world figure3")
def view(
    world: WorldOption = None,
    redis: RedisOption = None,
    speed: SpeedOption = None,
    state: StateOption = None,
    seed: SeedOption = None,
    namespace: NamespaceOption = "",
    host: HostOption = LOOPBACK,
    port: PortOption = DEFAULT_PORT,
) -> None:
    """Show the 3-D world in a browser, to see, point in and talk through; Ctrl-C ends it."""
    from .session import Options, run_view

    run_view(Options(world, redis, speed, state, seed, namespace, ViewOptions(host, port)))


@app.command(epilog="Example: kirby parse --json turn left forty five degrees")
def parse(
    text: Annotated[list[str] | None, typer.Argument(help="What is said; without it, a line each from a pipe.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object a line.")] = False,
    explain: Annotated[bool, typer.Option("--explain", help="Show tokens and derivation too.")] = False,
    world: WorldOption = None,
) -> None:
    """Show what Kirby makes of an utterance: the act, its logical form, and the commands that would be sent."""
    from .reading import reader, show_record

    if explain and as_json:
        raise typer.BadParameter("--explain is for people to read, --json for programs: give one of them")
    read = reader(world)
    show: Callable[[dict[str, Any]], str] = show_record
    if explain:
        from .explaining import explainer

        show = _also(explainer())
    utterances = [" ".join(text)] if text else (line.rstrip("\r\n") for line in sys.stdin)
    understood = True
    for utterance in utterances:
        record = read(utterance)
        understood = understood and record["status"] != "not_understood"
        print(json.dumps(record, ensure_ascii=False) if as_json else show(record), flush=True)
    raise typer.Exit(0 if understood or as_json else 1)


def _also(explained: Callable[[str], str]) -> Callable[[dict[str, Any]], str]:
    """A record as people read it, with how it was read before it."""
    from .reading import show_record

    return lambda record: f"{explained(record['utterance'])}\n{show_record(record)}"


@app.command(epilog="Example: kirby corpus my_commands.yaml")
def corpus(
    files: Annotated[list[Path] | None, typer.Argument(help="Corpora to run; without them, Kirby's own.")] = None,
) -> None:
    """Run utterance -> command corpora; a failing case shows what was expected and what came, step by step."""
    from .corpus import run_corpora

    raise typer.Exit(0 if run_corpora(tuple(files or ())) else 1)


@app.command(epilog="Example: kirby robot --redis redis://localhost:6379 --world figure3")
def robot(
    redis: RedisOption = None,
    world: WorldOption = None,
    speed: SpeedOption = None,
    state: StateOption = None,
    seed: SeedOption = None,
    namespace: NamespaceOption = "",
) -> None:
    """Run the robot's side alone, for any client of the bridge."""
    from .session import Options, run_robot

    run_robot(Options(world, redis, speed or "1", state, seed, namespace))


@app.command(epilog="Example: kirby lexicon show fiducial")
def lexicon(
    action: Annotated[str, typer.Argument(metavar="check|show|words|sample", help="What to do.")] = "check",
    word: Annotated[str | None, typer.Argument(help="The word to show, or how many sentences to sample.")] = None,
    folder: Annotated[Path | None, typer.Option("--folder", help="Another lexicon than Kirby's.")] = None,
) -> None:
    """Check the lexicon, show the entries of a word, list every word Kirby knows, or sample sentences with forms."""
    from .lexicon import run_lexicon

    run_lexicon(action, word, folder)


@app.command(epilog="Example: kirby train language")
def train(
    what: Annotated[str, typer.Argument(metavar="language", help="What to train.")],
    out: Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Where to, if not for Kirby itself.")] = None,
) -> None:
    """Train the model that guesses what was meant in words Kirby does not know; it asks before it acts on a guess."""
    from .train import run_train

    run_train(what, out)


@app.command(epilog="Example: kirby bench simulation --json")
def bench(
    name: Annotated[str | None, typer.Argument(help="Which benchmark; without it, their names.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="The figures as one JSON object.")] = False,
) -> None:
    """Run a benchmark and print its figures, as ratios to something measured in the same run."""
    from .bench import run_bench

    run_bench(name, as_json)


def main(arguments: list[str] | None = None) -> None:
    """The console script. Never returns: the process ends with the status this module's docstring gives."""
    from .rooms import check_rooms

    given = sys.argv[1:] if arguments is None else arguments
    if not given or (given[0].startswith("-") and given[0] not in _HELP):
        given = ["repl", *given]
    try:
        check_rooms()
        status: Any = app(args=given, prog_name="kirby", standalone_mode=False)
    except _WrongUse as error:
        where = error.ctx.command_path if error.ctx else "kirby"
        status = _fail(f"{error.format_message()} (see {where} --help)", 2)
    except (typer.Abort, KeyboardInterrupt):
        status = 130
    except BrokenPipeError:
        sys.stderr.close()  # the reader left; there is no one to tell
        status = 1
    except KirbyError as error:
        status = _fail(str(error), 2 if isinstance(error, UsageError) else 1)
    sys.exit(status if isinstance(status, int) else 0)


def _fail(message: str, status: int) -> int:
    print(f"kirby: {' '.join(message.split())}", file=sys.stderr)
    return status
