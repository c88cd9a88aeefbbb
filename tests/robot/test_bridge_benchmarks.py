"""Small instances of the bridge's benchmarks: the faults do no harm; of the speeds only that they are measured."""

import pytest

from benchmarks import bridge, faults


def test_a_few_kills_and_much_junk_do_no_harm():
    figures = faults.run(commands=90, robot_kills=3, redis_kills=1, fuzzed=3000)
    assert (figures["robot_kills"], figures["redis_kills"]) == (3, 1)
    assert (figures["lost"], figures["ended_twice"], figures["robot_ended_by_itself"]) == (0, 0, 0)
    assert figures["done"] + figures["refused"] + figures["otherwise"] == figures["commands"] == 90
    assert figures["junk_answered_invalid"] == figures["junk_entries"]
    assert (figures["crashes"], figures["obeys_afterwards"]) == (0, 1)
    assert figures["robot_mb_at_end"] < figures["robot_mb_at_half"] + 20.0


@pytest.mark.physics
def test_speeds_are_measured():
    figures = bridge.run(stops=2, trips=20, robots=2, robots_s=1.0, warm_up_s=6.0)
    assert figures["stop_trials"] == figures["stop_without_physics_trials"] == 2
    assert figures["round_trip_ratio"] > 0.0
    assert figures["robots_periods"] > 0
