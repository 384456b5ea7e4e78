//! Checks that a file's content matches its use; other files are not stored.

use crate::inspect::*;

#[test]
fn secrets_are_no_meshes_nor_images_nor_materials() {
    for secret in [
        "-----BEGIN OPENSSH PRIVATE KEY-----\nb3BlbnNzaC1rZXktdjEAAAAA\n",
        "{\"token\": \"ghp_0123\"}",
        "solid advice: root:x:0:0:root:/root:/bin/bash\n",
        "v 1 2\nv one two three\n",
        "<keys><key>1</key></keys>",
        "export TOKEN=abc\n",
        "",
    ] {
        let bytes = secret.as_bytes();
        assert!(!is_mesh(bytes, None), "{secret}");
        assert!(!is_image(bytes), "{secret}");
        assert_eq!(is_mtl(bytes), secret.is_empty(), "{secret}");
    }
    // A DER key, and random bytes.
    for bytes in [&[0x30, 0x82, 4, 0xa4, 2, 1, 0][..], &[7, 200, 3, 0, 0, 1, 9]] {
        assert!(!is_mesh(bytes, None) && !is_image(bytes), "{bytes:?}");
    }
}

#[test]
fn what_is_known_by_its_mark_is() {
    let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0";
    assert!(is_image(png));
    assert!(is_mtl(b"# a\nnewmtl red\nKd 1 0 0\n") && is_mtl(b"# none\n"));
    assert!(is_mesh(b"ply\nformat ascii 1.0\n", None));
    assert!(is_mesh(b"# made by\nv 0 0 1e-3\n", None));
    assert!(is_mesh(b"\xef\xbb\xbf<?xml version=\"1.0\"?><COLLADA/>", None));
}

/// Nothing is decoded, so that neither what a header states nor what follows it costs time.
#[test]
fn headers_of_images_take_time_in_proportion() {
    let marks: [&[u8]; 14] = [
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        b"\xff\xd8\xff\xe0\0\x10JFIF",
        b"\xff\xd8",
        b"GIF89a",
        b"BM",
        b"DDS ",
        b"\x76\x2f\x31\x01\x02\0\0\0",
        b"#?RADIANCE\n",
        b"\xabKTX 20\xbb\r\n\x1a\n",
        b"P6\n",
        b"II*\0\x08\0\0\0\xff\xff",
        b"MM\0*\0\0\0\x08\xff\xff",
        b"RIFF\xff\xff\xff\xffWEBPVP8X",
        b"\0\0\x02\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0",
    ];
    let fills: [&[u8]; 7] =
        [b"\0", b"\xff", b"\xff\xe0\0\x02", b"# \n", b"a\n", b" ", b"\x08\0\0\0"];
    for mark in marks {
        for fill in fills {
            let bytes = [mark, &fill.repeat((4 << 20) / fill.len())].concat();
            let start = std::time::Instant::now();
            is_image(&bytes);
            let took = start.elapsed();
            assert!(took.as_secs() < 5, "{mark:?} {fill:?}: {took:?}");
        }
    }
}
