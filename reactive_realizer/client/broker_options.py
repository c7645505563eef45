"""Options that say where a message broker is."""

import argparse
import os

from reactive_realizer.client.stomp_bus import Broker
from reactive_realizer.client.vh_message import SCOPE

_LOGIN, _PASSCODE = "VHMSG_LOGIN", "VHMSG_PASSCODE"
USER_OF_BROKER = (
    f"the user of the broker is taken from the environment ({_LOGIN}, {_PASSCODE}), and is guest by default"
)


def add_broker(parser: argparse.ArgumentParser) -> None:
    """Add the address of a broker, and the scope of the messages of the Virtual Human Toolkit."""
    add_address(parser, "--broker", (Broker().host, Broker().port), "the address of the broker")
    parser.add_argument("--scope", default=SCOPE, metavar="NAME", help=f"the scope of the messages, {SCOPE}")


def broker_of(options: argparse.Namespace) -> Broker:
    """The broker that the options and the environment name."""
    host, port = options.broker
    return Broker(host, port, os.environ.get(_LOGIN, "guest"), os.environ.get(_PASSCODE, "guest"))


def add_address(parser: argparse.ArgumentParser, name: str, default: tuple[str, int], text: str) -> None:
    """Add an option ``HOST:PORT``, or ``HOST`` with the default port."""
    host, port = default

    def address(text: str) -> tuple[str, int]:
        host, colon, number = text.partition(":")
        if not host or not 0 < (chosen := int(number) if colon else port) < 65536:
            raise ValueError(text)
        return host, chosen

    parser.add_argument(name, type=address, default=default, metavar="HOST:PORT", help=f"{text}, {host}:{port}")
