//! `connections_module` from the chain: SPEC 6.4.

use urdd_format::chain::ChainModule;
use urdd_format::connections::ConnectionsModule;
use urdd_format::index::LinkIdx;
use urdd_generate::kinematics::*;
use urdd_source::urdf;
use urdd_xml::Xml;

/// Links in a line; the file lists them from the far end to the root.
fn line(links: usize) -> ConnectionsModule {
    connections_module(&line_chain(links))
}

fn line_chain(links: usize) -> ChainModule {
    let mut xml = "<robot name=\"line\">".to_owned();
    for i in 0..links {
        xml += &format!("<link name=\"l{i}\"/>");
    }
    for i in 1..links {
        let above = i - 1;
        xml += &format!(
            "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l{i}\"/><child link=\"l{above}\"/></joint>"
        );
    }
    let reading = urdf::read(&Xml::new(&(xml + "</robot>")), "line").unwrap();
    chain_module(&reading.robot, &reading.tree)
}

#[test]
fn paths_along_a_line_are_ranges() {
    let count = 7;
    let module = line(count);
    let range = |from: usize, to: usize| -> Vec<LinkIdx> {
        let up = (from..=to).map(|link| LinkIdx(link as u32));
        let down = (to..=from).rev().map(|link| LinkIdx(link as u32));
        if from <= to { up.collect() } else { down.collect() }
    };
    let pairs = module.link_to_link_paths.unwrap();
    let descents = module.link_connection_paths.unwrap();
    for i in 0..count {
        // The root is the last link.
        assert_eq!(module.root_paths[i].links, range(count - 1, i));
        for j in 0..count {
            assert_eq!(module.lowest_common_ancestors[i][j], LinkIdx(i.max(j) as u32));
            assert_eq!(pairs[i][j].links, range(i, j));
            // Joint k is between links k and k + 1.
            let joints: Vec<u32> = pairs[i][j].joints.iter().map(|joint| joint.0).collect();
            let mut between: Vec<u32> = (i.min(j) as u32..i.max(j) as u32).collect();
            if i > j {
                between.reverse();
            }
            assert_eq!(joints, between);
            let below = match i.cmp(&j) {
                std::cmp::Ordering::Equal => Some(range(i, i)),
                std::cmp::Ordering::Greater => Some(range(i - 1, j)),
                std::cmp::Ordering::Less => None,
            };
            assert_eq!(descents[i][j], below);
        }
    }
}

/// Links that are all children of the first one.
fn star(links: usize) -> ChainModule {
    let link = |i: usize| format!("<link name=\"l{i}\"/>");
    let joint = |i: usize| {
        format!(
            "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l0\"/><child link=\"l{i}\"/></joint>"
        )
    };
    let links_in_file: String = (0..links).map(link).collect();
    let joints: String = (1..links).map(joint).collect();
    let xml = format!("<robot name=\"star\">{links_in_file}{joints}</robot>");
    let reading = urdf::read(&Xml::new(&xml), "star").unwrap();
    chain_module(&reading.robot, &reading.tree)
}

#[test]
fn above_300_links_the_paths_of_pairs_are_left_out() {
    assert!(connections_module(&star(300)).link_to_link_paths.is_some());
    let large = connections_module(&star(301));
    assert!(large.link_to_link_paths.is_none() && large.link_connection_paths.is_none());
    assert_eq!(large.root_paths[300].links.len(), 2);
}

#[test]
fn above_2_million_links_in_them_the_paths_of_pairs_are_left_out() {
    assert!(line(180).link_to_link_paths.is_some());
    let long = line(181);
    assert!(long.link_to_link_paths.is_none() && long.link_connection_paths.is_none());
    assert_eq!(long.root_paths[0].links.len(), 181);
}

#[test]
fn the_links_in_paths_are_counted_without_the_paths() {
    // A line of n links: each path has 1 + |i - j| links.
    for n in [1_usize, 2, 9] {
        let module = line(n);
        let pairs = module.link_to_link_paths.unwrap();
        let written: usize = pairs.iter().flatten().map(|path| path.links.len()).sum();
        assert_eq!(written, n * n + (n * n * n - n) / 3);
        assert_eq!(links_in_pairs(&line_chain(n)), written);
    }
    // A star: 1 for a link to itself, 2 from or to the centre, otherwise 3.
    assert_eq!(links_in_pairs(&star(10)), 10 + 2 * 9 * 2 + 9 * 8 * 3);
}
