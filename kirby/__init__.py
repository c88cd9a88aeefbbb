"""Kirby: steer a mobile robot with English and gesture. Hosts import from here and from nowhere else."""
