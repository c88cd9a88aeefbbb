"""The robot's benchmarks, each as a small instance: what they promise in full holds here too."""

from __future__ import annotations

import pytest

from benchmarks import fiducials, localisation, mapping, motion, navigation, simulation

pytestmark = pytest.mark.physics


def test_the_map_after_a_short_patrol_is_true() -> None:
    figures = mapping.run(worlds=["figure3"], patrol_s=90.0, sizes=(50, 200))
    assert figures["worst_coverage"] >= 0.9  # a patrol this short has seen some walls only from afar
    assert figures["worst_false_share"] <= 0.03
    assert figures["worst_segments_per_wall"] <= 1.3
    assert figures["figure3_contacts"] == 0
    assert figures["naive_200_left"] == pytest.approx(figures["merge_200_left"], rel=0.1)


def test_the_robot_knows_where_it_is_after_some_driving() -> None:
    figures = localisation.run(worlds=["corridor"], distance_m=12.0)
    assert figures["worst_final_error_m"] < 0.10
    assert figures["worst_final_error_deg"] < 2.0


def test_markers_are_found_where_they_are() -> None:
    figures = fiducials.run(views=40)
    assert figures["large_found_share"] >= 0.95
    assert figures["wrong_ids"] == 0
    assert figures["error_m_median"] <= 0.03
    assert figures["error_deg_median"] <= 3.0


def test_goals_are_reached_or_refused_without_a_touch() -> None:
    figures = navigation.run(worlds=["figure3"], goals=8)
    assert figures["reached_share"] == 1.0
    assert figures["reported_share"] == 1.0
    assert figures["contacts"] == 0
    assert figures["known_driven_to_shortest_max"] <= 1.15
    assert figures["unknown_driven_to_explorer_max"] <= 1.15


def test_a_metre_is_a_metre_and_an_angle_that_angle() -> None:
    figures = motion.run(trials=3)
    assert figures["forward_within"] == 1.0
    assert figures["turn_within"] == 1.0


def test_the_simulated_robot_keeps_most_of_the_bare_simulators_speed() -> None:
    figures = simulation.run(rounds=1, round_s=1.0)
    assert figures["simulated_seconds_per_second"] > 0
    assert figures["peak_memory_mb"] > 0
