"""Settings for the property tests of contract classes; needs Hypothesis."""

from hypothesis import HealthCheck, settings

inherited = settings(suppress_health_check=[HealthCheck.differing_executors], deadline=None)
"""Lets several classes inherit a property test, and removes the deadline, which a busy machine would miss."""
