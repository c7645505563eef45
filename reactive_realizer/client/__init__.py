"""A connection to a realizer over its protocol, for programs that use one."""
