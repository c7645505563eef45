"""Solves key poses: which rotations the joints of a group have so that its goals are met. Functions are pure."""
