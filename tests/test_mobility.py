from linkages import case, general_loop, spherical_four_bar

from nag.mechanism.loops import gruebler_kutzbach


def test_counting_fails_for_the_overconstrained_mechanisms():
    assert gruebler_kutzbach(case("bennett")) == -2
    assert gruebler_kutzbach(case("bricard-cube")) == 0


def test_planar_and_spherical_mechanisms_count_three_freedoms_a_body():
    assert gruebler_kutzbach(case("planar-four-bar")) == 1
    assert gruebler_kutzbach(spherical_four_bar()) == 1


def test_general_loop_has_six_freedoms_less_than_joints():
    for joints in (5, 6, 7):
        assert gruebler_kutzbach(general_loop(joints, 1)) == joints - 6
