"""Connections to a realizer over its protocol, and to a message broker, for programs that use them."""
